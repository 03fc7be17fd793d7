//! The words of a name.

/// The words of a name in lower case: parted by anything but letters and digits, where a capital
/// follows a small letter, and where a letter follows a digit; with `in_capitals` also before the
/// last of several capitals, `PCBBottom`.
pub(super) fn words(text: &str, in_capitals: bool) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut before = ' ';
    let mut rest = text.chars();
    while let Some(c) = rest.next() {
        let is_last = || rest.clone().next().is_some_and(|next| next.is_ascii_lowercase());
        let begins = match before {
            'a'..='z' => c.is_ascii_uppercase(),
            '0'..='9' => c.is_ascii_alphabetic(),
            'A'..='Z' => in_capitals && c.is_ascii_uppercase() && is_last(),
            _ => false,
        };
        let plain = without_accent(c);
        if !plain.is_ascii_alphanumeric() || begins {
            words.push(String::new());
        }
        if plain.is_ascii_alphanumeric() {
            words.last_mut().expect("never empty").push(plain.to_ascii_lowercase());
        }
        before = c;
    }
    words.retain(|word| !word.is_empty());
    words
}

/// A letter of western Europe without its accent.
const fn without_accent(c: char) -> char {
    match c {
        'à'..='å' | 'À'..='Å' => 'a',
        'ç' | 'Ç' => 'c',
        'è'..='ë' | 'È'..='Ë' => 'e',
        'ì'..='ï' | 'Ì'..='Ï' => 'i',
        'ñ' | 'Ñ' => 'n',
        'ò'..='ö' | 'Ò'..='Ö' => 'o',
        'ù'..='ü' | 'Ù'..='Ü' => 'u',
        'ß' => 's',
        _ => c,
    }
}

/// How many bytes at the start all `names` share, up to the last mark that parts words; all of one
/// by which more than two begin, which is the board's name: `comp1.cmp`, `comp1.sol`, `comp1.drd`.
pub(in crate::import) fn shared_start(names: &[&str]) -> usize {
    /// A layer and its holes may have one name, `bottom.gbr` and `bottom.drl`. Chosen.
    const MANY: usize = 3;
    let Some((first, rest)) = names.split_first().filter(|(_, rest)| !rest.is_empty()) else { return 0 };
    let shared = rest.iter().fold(first.len(), |shared, name| {
        first.bytes().zip(name.bytes()).take(shared).take_while(|(a, b)| a == b).count()
    });
    let ends = |name: &&str| name.as_bytes().get(shared).is_none_or(|b| !b.is_ascii_alphanumeric());
    if names.len() >= MANY && names.iter().all(ends) {
        return shared;
    }
    first.as_bytes()[..shared].iter().rposition(|b| !b.is_ascii_alphanumeric()).map_or(0, |i| i + 1)
}
