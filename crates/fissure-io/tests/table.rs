//! Tables come back as they were written, and what is wrong with one is named.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests are tests"
)]

use std::fs;

use fissure_io::table::{Cell, Table, TableError, TableWriter};

#[test]
fn a_streamed_table_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("curve.csv");
    let columns = [
        vec![0.1 + 0.2, -0.0, 5e-324],
        vec![1e300, 2.9e-7, -1.0 / 3.0],
    ];
    let mut writer = TableWriter::create(&path, &["delta [m]", "force [N]", "law"]).unwrap();
    for (row, law) in ["linear", "exponential, \"soft\"", "# none"]
        .into_iter()
        .enumerate()
    {
        writer
            .row([
                Cell::from(columns[0][row]),
                columns[1][row].into(),
                law.into(),
            ])
            .unwrap();
    }
    writer.flush().unwrap();
    let text = fs::read_to_string(&path).unwrap();
    assert!(
        text.starts_with("delta [m],force [N],law\n0.30000000000000004,1e300,linear\n"),
        "{text}"
    );
    let error = writer.row([1.0, 2.0]).unwrap_err();
    assert!(
        matches!(
            error,
            TableError::Width {
                found: 2,
                expected: 3
            }
        ),
        "{error}"
    );
    writer.finish().unwrap();

    let table = Table::read(&path).unwrap();
    let bits = |values: &[f64]| {
        values
            .iter()
            .map(|value| value.to_bits())
            .collect::<Vec<_>>()
    };
    assert_eq!(bits(&table.numbers("delta").unwrap()), bits(&columns[0]));
    assert_eq!(
        bits(&table.numbers("force [N]").unwrap()),
        bits(&columns[1])
    );
    assert_eq!(
        table.texts("law").unwrap(),
        ["linear", "exponential, \"soft\"", "# none"]
    );
    assert_eq!(
        (
            table.len(),
            table.unit("delta").unwrap(),
            table.unit("law").unwrap()
        ),
        (3, Some("m"), None)
    );
}

#[test]
fn the_whole_and_the_streamed_form_write_the_same_file() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, streamed) = (
        folder.path().join("whole.csv"),
        folder.path().join("streamed.csv"),
    );
    let mut table = Table::new(&["t [s]", "E [J]"]).unwrap();
    let mut writer = TableWriter::create(&streamed, &["t [s]", "E [J]"]).unwrap();
    for step in 0..100_u32 {
        let row = [f64::from(step) * 1e-7, f64::from(step).sqrt()];
        table.row(row).unwrap();
        writer.row(row).unwrap();
    }
    table.write(&whole).unwrap();
    writer.finish().unwrap();
    assert_eq!(fs::read(&whole).unwrap(), fs::read(&streamed).unwrap());
    assert_eq!(
        table.numbers("E").unwrap(),
        Table::read(&whole).unwrap().numbers("E").unwrap()
    );
}

#[test]
fn reference_data_may_have_comments_and_spaces() {
    let text = "# source: somewhere\n x [mm] , y\n 1, 2 \n# in between\n3 ,4e0\n";
    let table = Table::parse("figure 3", text).unwrap();
    assert_eq!(table.names().collect::<Vec<_>>(), ["x", "y"]);
    assert_eq!(table.numbers("x").unwrap(), [1.0, 3.0]);
    assert_eq!(table.numbers("y").unwrap(), [2.0, 4.0]);
}

#[test]
fn what_is_wrong_is_named() {
    let table = Table::parse("figure 3", "# a\nx [m],y\n1,2\n3,\n").unwrap();
    let error = table.numbers("y").unwrap_err();
    assert_eq!(
        error.to_string(),
        "'figure 3', line 4, column 'y': \"\" is not a number"
    );
    let error = table.numbers("z").unwrap_err();
    assert_eq!(
        error.to_string(),
        "'figure 3' has no column 'z'; it has x, y"
    );
    assert!(
        matches!(table.numbers("x [mm]"), Err(TableError::Missing { .. })),
        "the unit has to be the file's"
    );

    assert!(matches!(
        Table::parse("ragged", "a,b\n1\n"),
        Err(TableError::Csv { .. })
    ));
    assert!(matches!(
        Table::parse("empty", ""),
        Err(TableError::Unnamed { column: 1 })
    ));
    assert!(matches!(
        Table::new(&["a [m]", "a [mm]"]),
        Err(TableError::Duplicate { .. })
    ));
    assert!(matches!(
        Table::new(&["a", "[m]"]),
        Err(TableError::Unnamed { column: 2 })
    ));
    let error = Table::read("no/such.csv").unwrap_err();
    assert!(error.to_string().contains("no/such.csv"), "{error}");
}

#[test]
fn columns_become_a_table_or_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("curve.csv");
    let columns = [
        ("delta [m]", vec![1e-6, 2e-6]),
        ("force [N]", vec![120.0, f64::NAN]),
    ];
    Table::from_columns(columns).unwrap().write(&path).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    assert_eq!(text, "delta [m],force [N]\n1e-6,120\n2e-6,NaN\n");
    let ragged = Table::from_columns([("a", vec![1.0]), ("b", vec![])]);
    assert!(matches!(
        ragged,
        Err(TableError::Length {
            found: 0,
            expected: 1,
            ..
        })
    ));
    let twice = Table::from_columns([("a [m]", [1.0]), ("a [N]", [1.0])]);
    assert!(matches!(twice, Err(TableError::Duplicate { .. })));
    let none: [(&str, [f64; 0]); 0] = [];
    assert!(matches!(
        Table::from_columns(none),
        Err(TableError::Unnamed { .. })
    ));
}
