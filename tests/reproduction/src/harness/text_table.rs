//! A table of text with aligned columns, for terminals and for Markdown.

use serde::{Deserialize, Serialize};

/// Rows of cells below a head.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TextTable {
    /// What it shows.
    pub title: String,
    head: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl TextTable {
    /// An empty table; the first column names the rows.
    pub fn new(title: impl Into<String>, head: &[impl ToString]) -> Self {
        Self { title: title.into(), head: head.iter().map(ToString::to_string).collect(), rows: Vec::new() }
    }

    /// Adds a row; missing cells stay empty.
    pub fn row(&mut self, name: impl Into<String>, cells: impl IntoIterator<Item = String>) {
        let mut row = vec![name.into()];
        row.extend(cells);
        row.resize(self.head.len(), String::new());
        self.rows.push(row);
    }

    fn widths(&self) -> Vec<usize> {
        let all = || std::iter::once(&self.head).chain(&self.rows);
        (0..self.head.len()).map(|i| all().map(|row| row[i].chars().count()).max().unwrap_or(0)).collect()
    }

    /// For a terminal.
    pub fn text(&self) -> String {
        let widths = self.widths();
        let line = |row: &[String]| {
            let cells: Vec<String> = row
                .iter()
                .zip(&widths)
                .enumerate()
                .map(|(i, (cell, &width))| if i == 0 { format!("{cell:<width$}") } else { format!("{cell:>width$}") })
                .collect();
            format!("  {}", cells.join("   ").trim_end())
        };
        let mut lines = vec![self.title.clone(), line(&self.head)];
        lines.extend(self.rows.iter().map(|row| line(row)));
        lines.join("\n")
    }

    /// For a report.
    pub fn markdown(&self) -> String {
        let line = |row: &[String]| {
            let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|")).collect();
            format!("| {} |", cells.join(" | "))
        };
        let mut lines = vec![format!("{}:\n", self.title), line(&self.head), "|---".repeat(self.head.len()) + "|"];
        lines.extend(self.rows.iter().map(|row| line(row)));
        lines.join("\n")
    }
}

#[cfg(test)]
mod tests {
    use super::TextTable;

    #[test]
    fn columns_line_up() {
        let mut table = TextTable::new("Accuracy", &["bound", "1", "9"]);
        table.row("VaR .95", ["0.97".into(), "1".into()]);
        table.row("α", ["–".into()]);
        let markdown = "Accuracy:\n\n| bound | 1 | 9 |\n|---|---|---|\n| VaR .95 | 0.97 | 1 |\n| α | – |  |";
        assert_eq!(table.markdown(), markdown);
        assert_eq!(table.text(), "Accuracy\n  bound        1   9\n  VaR .95   0.97   1\n  α            –");
    }
}
