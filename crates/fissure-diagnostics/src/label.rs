//! Labels of columns, `time [s]`, and the names in them.

/// Whether a column with this label is meant by `asked`: the label itself or the name before the
/// unit.
pub(crate) fn is_called(label: &str, asked: &str) -> bool {
    let name = label.strip_suffix(']').and_then(|l| l.rsplit_once('['));
    label == asked || name.is_some_and(|(name, _)| name.trim_end() == asked)
}

#[cfg(test)]
mod tests {
    use super::is_called;

    #[test]
    fn a_column_answers_to_its_label_and_its_name() {
        assert!(is_called("time [s]", "time") && is_called("time [s]", "time [s]"));
        assert!(is_called("steps", "steps"));
        assert!(!is_called("time [s]", "time [ms]") && !is_called("time [s]", "tim"));
    }
}
