//! An aligned table that grows one row at a time.

use crate::number_text::short;
use crate::parameters::Parameters;
use crate::row::{Field, Row};
use crate::simulation_row::OWN_COLUMNS;

/// Columns are at least this wide, so that a later number seldom outgrows its column.
const LEAST_NUMBER_WIDTH: usize = 8;

struct Cell {
    title: String,
    text: String,
    left: bool,
}

/// Formats rows as they come.
///
/// A row with other columns than the one before starts a new header.
pub(crate) struct Table {
    titles: Vec<String>,
    widths: Vec<usize>,
    hints: Vec<(String, usize)>,
    varying: Vec<&'static str>,
}

impl Table {
    /// A table for the results of these cases.
    ///
    /// The cases tell how wide their own values will get before any row is there.
    pub(crate) fn new(cases: &[Parameters]) -> Self {
        let mut hints: Vec<(String, usize)> = Vec::new();
        let labels = cases
            .iter()
            .map(|case| ("case", case.label_without(&OWN_COLUMNS)));
        let values = cases.iter().flat_map(|case| {
            case.iter()
                .map(|(name, value)| (name, text_of(&Field::from(value))))
        });
        for (name, text) in labels.chain(values) {
            let width = text.chars().count();
            match hints.iter_mut().find(|(known, _)| known == name) {
                Some((_, widest)) => *widest = width.max(*widest),
                None => hints.push((name.to_owned(), width)),
            }
        }
        Self {
            titles: Vec::new(),
            widths: Vec::new(),
            hints,
            varying: cases
                .first()
                .map(|case| case.varying().to_vec())
                .unwrap_or_default(),
        }
    }

    /// The lines for one more row.
    pub(crate) fn lines(&mut self, row: &Row) -> String {
        let cells = self.cells(row);
        let mut lines = String::new();
        if !self.titles.iter().eq(cells.iter().map(|cell| &cell.title)) {
            if !self.titles.is_empty() {
                lines.push('\n');
            }
            self.start(&cells);
            let header: Vec<(&str, bool)> = cells
                .iter()
                .map(|cell| (cell.title.as_str(), cell.left))
                .collect();
            lines.push_str(&self.line(&header));
        }
        let texts: Vec<(&str, bool)> = cells
            .iter()
            .map(|cell| (cell.text.as_str(), cell.left))
            .collect();
        lines.push_str(&self.line(&texts));
        lines
    }

    fn start(&mut self, cells: &[Cell]) {
        self.titles = cells.iter().map(|cell| cell.title.clone()).collect();
        self.widths = cells
            .iter()
            .map(|cell| {
                let least = if cell.left { 1 } else { LEAST_NUMBER_WIDTH };
                let hint = self
                    .hints
                    .iter()
                    .find(|(name, _)| *name == cell.title)
                    .map_or(0, |(_, width)| *width);
                let title = cell.title.chars().count();
                cell.text.chars().count().max(least).max(hint).max(title)
            })
            .collect();
    }

    fn line(&self, texts: &[(&str, bool)]) -> String {
        let mut line = String::new();
        for ((text, left), width) in texts.iter().zip(&self.widths) {
            if !line.is_empty() {
                line.push_str("  ");
            }
            if *left {
                line.push_str(&format!("{text:<width$}"));
            } else {
                line.push_str(&format!("{text:>width$}"));
            }
        }
        line.truncate(line.trim_end().len());
        line.push('\n');
        line
    }

    fn cells(&self, row: &Row) -> Vec<Cell> {
        let mut cells = Vec::new();
        for (name, field) in row.fields().iter() {
            match (name, field) {
                // The study is the heading of the whole table.
                ("study", _) => {}
                ("parameters", Field::Group(parameters)) => {
                    let shown = parameters.iter().filter(|(parameter, _)| {
                        self.varying.contains(parameter) && !is_told(row, parameter)
                    });
                    // In front, where the eye looks for what tells the rows apart.
                    let shown: Vec<Cell> = shown
                        .map(|(parameter, value)| cell(parameter.to_owned(), value))
                        .collect();
                    cells.splice(0..0, shown);
                }
                ("errors", Field::Group(errors)) => cells.extend(
                    errors
                        .iter()
                        .map(|(error, value)| cell(format!("error.{error}"), value)),
                ),
                (_, Field::Group(fields)) => cells.extend(
                    fields
                        .iter()
                        .map(|(field, value)| cell(field.to_owned(), value)),
                ),
                (_, _) => cells.push(cell(name.to_owned(), field)),
            }
        }
        cells
    }
}

/// Whether a column of the row tells the parameter's value already.
fn is_told(row: &Row, parameter: &str) -> bool {
    let named = |part: &str| {
        part.split_once('=')
            .is_some_and(|(name, _)| name == parameter)
    };
    let in_case = match row.fields().get("case") {
        Some(Field::Text(case)) => case.split(' ').any(named),
        _ => false,
    };
    in_case || row.fields().get(parameter).is_some()
}

fn cell(title: String, field: &Field) -> Cell {
    Cell {
        title,
        text: text_of(field),
        left: matches!(field, Field::Text(_) | Field::Flag(_)),
    }
}

fn text_of(field: &Field) -> String {
    match field {
        Field::Number(number) => short(*number),
        Field::Count(count) => count.to_string(),
        Field::Text(text) if text.is_empty() => "-".to_owned(),
        Field::Text(text) => text.clone(),
        Field::Flag(flag) => if *flag { "yes" } else { "no" }.to_owned(),
        Field::Numbers(numbers) => {
            let texts: Vec<String> = numbers.iter().map(|number| short(*number)).collect();
            format!("[{}]", texts.join(" "))
        }
        // Too long for a cell; JSON and CSV hold them.
        Field::Pairs(pairs) => format!("{} points", pairs.len()),
        Field::Group(fields) => {
            let texts: Vec<String> = fields
                .iter()
                .map(|(name, value)| format!("{name}={}", text_of(value)))
                .collect();
            texts.join(" ")
        }
    }
}
