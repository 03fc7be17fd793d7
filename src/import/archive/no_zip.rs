//! Instead of zip archives, where the crate was built without the feature `zip`.

use super::Gathered;
use crate::import::error::Error;

impl Gathered {
    /// Fails: nothing here reads archives.
    #[expect(clippy::unused_self, clippy::needless_pass_by_ref_mut, reason = "as where they are read")]
    pub(super) fn zip(&mut self, shown: &str, _: Vec<u8>) -> Result<(), Error> {
        let what = "this build cannot read zip archives (feature `zip`)";
        Err(Error::content(shown, what, "unpack it and give the folder"))
    }
}
