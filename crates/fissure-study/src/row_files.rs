//! The result rows as files, for `--out`.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::report::ReportError;
use crate::row::{Field, Fields, Row};

/// Writes `rows.jsonl` as the rows come and `rows.csv` when they are all there.
///
/// The header of a CSV file needs the columns of every row; the lines of the other file
/// are there for a run that does not reach its end.
pub(crate) struct RowFiles {
    directory: PathBuf,
    lines_path: PathBuf,
    lines: File,
    columns: Vec<String>,
    rows: Vec<Vec<(String, String)>>,
}

impl RowFiles {
    pub(crate) fn create(directory: &Path) -> Result<Self, ReportError> {
        fs::create_dir_all(directory).map_err(ReportError::file(directory))?;
        let lines_path = directory.join("rows.jsonl");
        let lines = File::create(&lines_path).map_err(ReportError::file(&lines_path))?;
        Ok(Self {
            directory: directory.to_owned(),
            lines_path,
            lines,
            columns: Vec::new(),
            rows: Vec::new(),
        })
    }

    pub(crate) fn directory(&self) -> &Path {
        &self.directory
    }

    pub(crate) fn row(&mut self, row: &Row, json: &str) -> Result<(), ReportError> {
        writeln!(self.lines, "{json}").map_err(ReportError::file(&self.lines_path))?;
        let mut cells = Vec::new();
        flatten("", row.fields(), &mut cells);
        for (column, _) in &cells {
            if !self.columns.contains(column) {
                self.columns.push(column.clone());
            }
        }
        self.rows.push(cells);
        Ok(())
    }

    pub(crate) fn finish(&self) -> Result<(), ReportError> {
        let path = self.directory.join("rows.csv");
        self.write_table(&path).map_err(ReportError::table(&path))
    }

    fn write_table(&self, path: &Path) -> Result<(), csv::Error> {
        let mut writer = csv::Writer::from_path(path)?;
        if self.columns.is_empty() {
            return Ok(());
        }
        writer.write_record(&self.columns)?;
        for row in &self.rows {
            writer.write_record(self.columns.iter().map(|column| {
                row.iter()
                    .find(|(name, _)| name == column)
                    .map_or("", |(_, text)| text.as_str())
            }))?;
        }
        writer.flush()?;
        Ok(())
    }
}

/// Names a field inside a group `group.field` and writes numbers so that they read
/// back exactly.
fn flatten(prefix: &str, fields: &Fields, cells: &mut Vec<(String, String)>) {
    for (name, field) in fields.iter() {
        let name = format!("{prefix}{name}");
        let text = match field {
            Field::Group(inner) => {
                flatten(&format!("{name}."), inner, cells);
                continue;
            }
            Field::Number(number) => number.to_string(),
            Field::Count(count) => count.to_string(),
            Field::Text(text) => text.clone(),
            Field::Flag(flag) => flag.to_string(),
            Field::Numbers(numbers) => {
                let texts: Vec<String> = numbers.iter().map(f64::to_string).collect();
                texts.join(" ")
            }
            Field::Pairs(pairs) => {
                let texts: Vec<String> = pairs.iter().map(|[x, y]| format!("{x}:{y}")).collect();
                texts.join(" ")
            }
        };
        cells.push((name, text));
    }
}
