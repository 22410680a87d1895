//! Small tables of text with aligned columns.

use std::fmt;

/// A table, column by column.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    columns: Vec<Column>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Column {
    name: String,
    cells: Vec<String>,
}

impl Table {
    /// Adds a column at the right.
    pub fn column(&mut self, name: &str, cells: impl IntoIterator<Item = String>) {
        self.columns.push(Column {
            name: name.to_owned(),
            cells: cells.into_iter().collect(),
        });
    }
}

impl Column {
    fn width(&self) -> usize {
        let texts = self.cells.iter().chain([&self.name]);
        texts.map(|text| text.chars().count()).max().unwrap_or(0)
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rows = self.columns.iter().map(|column| column.cells.len());
        let mut header = String::new();
        for column in &self.columns {
            push_cell(&mut header, &column.name, column.width());
        }
        writeln!(f, "{}", header.trim_end())?;
        for row in 0..rows.max().unwrap_or(0) {
            let mut line = String::new();
            for column in &self.columns {
                let cell = column.cells.get(row).map_or("", String::as_str);
                push_cell(&mut line, cell, column.width());
            }
            writeln!(f, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

fn push_cell(line: &mut String, cell: &str, width: usize) {
    if !line.is_empty() {
        line.push_str("  ");
    }
    line.push_str(cell);
    let padding = width.saturating_sub(cell.chars().count());
    line.extend(std::iter::repeat_n(' ', padding));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_under_their_names() {
        let mut table = Table::default();
        table.column("time_ms", ["0", "1000"].map(String::from));
        table.column("G", ["1 2", ""].map(String::from));
        table.column("température", ["0", "1"].map(String::from));
        let expected = "\
time_ms  G    température
0        1 2  0
1000          1
";
        assert_eq!(table.to_string(), expected);
    }
}
