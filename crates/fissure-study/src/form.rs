//! How large a run of a study is.

/// The form of a study: which cases it runs where the user sets nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// That of every day.
    #[default]
    Standard,
    /// One small enough for a test.
    Quick,
    /// One in full, which may take days; not every study has it.
    Full,
}

impl Form {
    /// In one word, for `the ... run`.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Standard => "default",
            Self::Quick => "quick",
            Self::Full => "full",
        }
    }
}
