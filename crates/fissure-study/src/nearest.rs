//! The known name a mistyped one was probably meant to be.

/// The number of single-character insertions, deletions and replacements that turn
/// `first` into `second`.
fn edit_distance(first: &str, second: &str) -> usize {
    let second: Vec<char> = second.chars().collect();
    let mut previous: Vec<usize> = (0..=second.len()).collect();
    for (row, letter) in first.chars().enumerate() {
        let mut current = vec![row + 1];
        let mut left = row + 1;
        for (other, pair) in second.iter().zip(previous.windows(2)) {
            let (diagonal, above) = match pair {
                [diagonal, above] => (*diagonal, *above),
                _ => continue,
            };
            let replaced = diagonal + usize::from(letter != *other);
            left = replaced.min(above + 1).min(left + 1);
            current.push(left);
        }
        previous = current;
    }
    previous.last().copied().unwrap_or(0)
}

/// The closest of `known` to `name`, unless even that shares too little with it.
///
/// A suggestion further away than about half the word would only mislead.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = 1 + name.chars().count() / 3;
    known
        .into_iter()
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .min_by_key(|(distance, _)| *distance)
        .filter(|(distance, _)| *distance <= limit)
        .map(|(_, candidate)| candidate)
}

/// The suggestion as a clause for an error message; empty without one.
pub(crate) fn suggestion<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    nearest(name, known)
        .map(|candidate| format!(" (did you mean '{candidate}'?)"))
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_of_known_pairs() {
        assert_eq!(edit_distance("kitten", "sitting"), 3);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("abc", ""), 3);
        assert_eq!(edit_distance("young", "young"), 0);
    }

    #[test]
    fn suggests_only_what_is_near() {
        let known = ["young", "poisson", "density"];
        assert_eq!(nearest("yung", known), Some("young"));
        assert_eq!(nearest("poison", known), Some("poisson"));
        assert_eq!(nearest("viscosity", known), None);
    }
}
