//! Rows of texts as comma-separated values.

/// A header and rows as CSV.
///
/// # Panics
/// Never: rows of one length are written into memory.
pub(super) fn csv(header: Vec<String>, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in std::iter::once(header).chain(rows) {
        writer.write_record(row).expect("rows of one length");
    }
    let bytes = writer.into_inner().expect("written into memory");
    String::from_utf8(bytes).expect("made of texts")
}

/// A number or nothing.
pub(super) fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}
