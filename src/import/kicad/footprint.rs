//! What a footprint is called on its board.

use super::tree::Node;

/// The reference of a footprint, `R1`: a property since version 8, a text before.
pub(super) fn reference(node: Node<'_>) -> Option<String> {
    let property = || {
        let named = |list: &Node<'_>| list.argument(0).is_some_and(|name| name.text() == "Reference");
        node.all("property").find(named)
    };
    let text = || {
        let of_reference = |list: &Node<'_>| list.argument(0).is_some_and(|kind| kind.raw() == b"reference");
        node.all("fp_text").find(of_reference)
    };
    let said = property().or_else(text)?.argument(1)?.text().into_owned();
    (!said.is_empty()).then_some(said)
}
