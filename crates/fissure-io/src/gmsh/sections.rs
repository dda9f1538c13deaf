//! The sections of a file and the words in them.

use std::path::Path;
use std::str::{FromStr, SplitWhitespace};

use super::GmshError;

/// The words of a section, one after another.
pub(super) struct Words<'a> {
    path: &'a Path,
    lines: &'a [&'a str],
    /// Line that is read now, from 0 in the file.
    line: usize,
    /// One past the last line of the section.
    end: usize,
    words: SplitWhitespace<'a>,
}

/// The lines of `$section`, without the first and the last; None without it.
fn lines_of(lines: &[&str], section: &'static str) -> Option<(usize, Option<usize>)> {
    let is = |line: &&str, mark: &str| {
        let name = line.trim().strip_prefix('$');
        name.and_then(|name| name.strip_prefix(mark)) == Some(section)
    };
    let start = lines.iter().position(|line| is(line, ""))? + 1;
    let end = lines[start..].iter().position(|line| is(line, "End"));
    Some((start, end.map(|end| start + end)))
}

impl<'a> Words<'a> {
    /// The words of a section, None if there is none.
    pub(super) fn of(
        path: &'a Path,
        lines: &'a [&'a str],
        section: &'static str,
    ) -> Result<Option<Self>, GmshError> {
        match lines_of(lines, section) {
            None => Ok(None),
            Some((start, Some(end))) => Ok(Some(Self {
                path,
                lines,
                line: start,
                end,
                words: lines[start..end].first().unwrap_or(&"").split_whitespace(),
            })),
            Some((_, None)) => Err(missing(path, section)),
        }
    }

    /// The words of a section that must be there.
    pub(super) fn required(
        path: &'a Path,
        lines: &'a [&'a str],
        section: &'static str,
    ) -> Result<Self, GmshError> {
        Self::of(path, lines, section)?.ok_or_else(|| missing(path, section))
    }

    /// Line of the word last read, from 1.
    pub(super) fn line(&self) -> usize {
        self.line + 1
    }

    pub(super) fn word(&mut self, expected: &'static str) -> Result<&'a str, GmshError> {
        loop {
            if let Some(word) = self.words.next() {
                return Ok(word);
            }
            if self.line + 1 >= self.end {
                let end = self.lines.get(self.end).unwrap_or(&"");
                return Err(self.refuse(self.end + 1, expected, end));
            }
            self.line += 1;
            self.words = self.lines[self.line].split_whitespace();
        }
    }

    pub(super) fn number<T: FromStr>(&mut self, expected: &'static str) -> Result<T, GmshError> {
        let word = self.word(expected)?;
        let number = word.parse();
        number.map_err(|_| self.refuse(self.line(), expected, word))
    }

    /// A coordinate.
    pub(super) fn finite(&mut self) -> Result<f64, GmshError> {
        let expected = "a finite coordinate";
        let word = self.word(expected)?;
        let number = word.parse().ok().filter(|x: &f64| x.is_finite());
        number.ok_or_else(|| self.refuse(self.line(), expected, word))
    }

    /// The text between the quotation marks of the present line.
    pub(super) fn quoted(&mut self) -> Result<String, GmshError> {
        let line = self.lines[self.line];
        let inner = line
            .split_once('"')
            .and_then(|(_, rest)| rest.rsplit_once('"'));
        let Some((name, _)) = inner else {
            return Err(self.refuse(self.line(), "a name in quotation marks", line));
        };
        self.words = "".split_whitespace();
        Ok(name.to_owned())
    }

    fn refuse(&self, line: usize, expected: &'static str, found: &str) -> GmshError {
        GmshError::Line {
            path: self.path.to_owned(),
            line,
            expected,
            found: found.to_owned(),
        }
    }
}

fn missing(path: &Path, section: &'static str) -> GmshError {
    GmshError::Section {
        path: path.to_owned(),
        section,
    }
}
