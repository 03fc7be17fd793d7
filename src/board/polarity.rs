//! Clear features subtracted exactly: the one place that knows the boolean library.
