//! Parts of a line: from a number to another.

/// Makes one of all spans that meet; sorted by where they begin, before and after.
pub(crate) fn merge<T: Copy + PartialOrd>(spans: &mut Vec<(T, T)>) {
    spans.dedup_by(|next, span| {
        let meets = next.0 <= span.1;
        if meets && next.1 > span.1 {
            span.1 = next.1;
        }
        meets
    });
}
