//! A checkpoint is read back bit for bit or refused with the name of what is wrong.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests are tests"
)]

use std::fs;
use std::path::Path;

use fissure_io::checkpoint::{CheckpointError, CheckpointReader, CheckpointWriter};
use serde::{Deserialize, Serialize};

#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Clock {
    step: u64,
    time: f64,
    label: String,
}

fn small(path: &Path) -> Vec<u8> {
    let mut checkpoint = CheckpointWriter::new();
    checkpoint
        .put("velocity", &[[1.0_f64, -0.0], [2.5, f64::NAN]])
        .unwrap();
    checkpoint.put("ids", &[7_u32, 0, 4711]).unwrap();
    checkpoint.put_value("clock", &(812_u64, 1.3e-4)).unwrap();
    checkpoint.write(path).unwrap();
    fs::read(path).unwrap()
}

#[test]
fn every_bit_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bits");
    let odd: Vec<f64> = [
        0,
        1,
        1 << 63,
        0x7ff0_0000_0000_0000,
        0x7ff8_0000_dead_beef,
        0x7ff4_0000_0000_0001,
        0xfff8_1234_5678_9abc,
    ]
    .map(f64::from_bits)
    .to_vec();
    let tensors = vec![[[1.0, 2.0, 3.0], [4.0, -0.0, 6.0], [7.0, 8.0, 9.0]]; 5];
    let clock = Clock {
        step: 812,
        time: 1.3e-4,
        label: "bar".to_owned(),
    };
    let empty: [f64; 0] = [];

    let mut writer = CheckpointWriter::new();
    writer
        .put("odd", &odd)
        .unwrap()
        .put("tensors", &tensors)
        .unwrap()
        .put("empty", &empty)
        .unwrap();
    writer
        .put_value("clock", &clock)
        .unwrap()
        .put_bytes("raw", vec![0, 255, 3])
        .unwrap();
    writer
        .put("flags", &[0_u8, 1])
        .unwrap()
        .put("seeds", &[u64::MAX])
        .unwrap();
    writer.write(&path).unwrap();

    let reader = CheckpointReader::open(&path).unwrap();
    let bits = |values: &[f64]| {
        values
            .iter()
            .map(|value| value.to_bits())
            .collect::<Vec<_>>()
    };
    assert_eq!(bits(&reader.get::<f64>("odd").unwrap()), bits(&odd));
    assert_eq!(reader.get::<[[f64; 3]; 3]>("tensors").unwrap(), tensors);
    assert_eq!(
        reader.get::<[f64; 9]>("tensors").unwrap().len(),
        5,
        "the same nine numbers, flat"
    );
    assert!(reader.get::<f64>("empty").unwrap().is_empty());
    assert_eq!(reader.get_value::<Clock>("clock").unwrap(), clock);
    assert_eq!(reader.get_bytes("raw").unwrap(), [0, 255, 3]);
    assert_eq!(reader.get::<u8>("flags").unwrap(), [0, 1]);
    assert_eq!(reader.get::<u64>("seeds").unwrap(), [u64::MAX]);
    let names: Vec<_> = reader.sections().map(|(name, _)| name).collect();
    assert_eq!(
        names,
        ["odd", "tensors", "empty", "clock", "raw", "flags", "seeds"]
    );
}

#[test]
fn the_same_state_gives_the_same_file() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(
        small(&folder.path().join("a")),
        small(&folder.path().join("b"))
    );
}

/// Length of the header's fixed part, from the format's documentation.
const PREAMBLE: usize = 28;

#[test]
fn every_flipped_bit_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flipped");
    let whole = small(&path);
    // Sections lie at the end, in order: velocity 32 bytes, ids 12, clock the rest.
    let clock = postcard::to_stdvec(&(812_u64, 1.3e-4)).unwrap().len();
    let clock_at = whole.len() - clock;
    let (ids_at, velocity_at) = (clock_at - 12, clock_at - 12 - 32);
    assert!(velocity_at > PREAMBLE);

    for byte in 0..whole.len() {
        for bit in 0..8 {
            let mut flipped = whole.clone();
            flipped[byte] ^= 1 << bit;
            fs::write(&path, &flipped).unwrap();
            let error = CheckpointReader::open(&path).expect_err("a flipped bit must be refused");
            let place = match byte {
                _ if byte < velocity_at => "header",
                _ if byte < ids_at => "'velocity'",
                _ if byte < clock_at => "'ids'",
                _ => "'clock'",
            };
            let version =
                matches!(error, CheckpointError::Version { .. }) && (8..12).contains(&byte);
            assert!(
                version || error.to_string().contains(place),
                "byte {byte} bit {bit}: {error}"
            );
            assert!(
                error.to_string().contains("flipped"),
                "the file is named: {error}"
            );
        }
    }
}

#[test]
fn every_truncation_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("short");
    let whole = small(&path);
    for length in 0..whole.len() {
        fs::write(&path, &whole[..length]).unwrap();
        let error = CheckpointReader::open(&path)
            .expect_err("a truncated file must be refused")
            .to_string();
        let named = ["header", "'velocity'", "'ids'", "'clock'"]
            .iter()
            .any(|place| error.contains(place));
        assert!(named, "{length} bytes: {error}");
    }
    fs::write(&path, &whole[..whole.len() - 1]).unwrap();
    let error = CheckpointReader::open(&path).unwrap_err();
    assert!(
        matches!(&error, CheckpointError::Truncated { section, .. } if section == "clock"),
        "{error}"
    );
    fs::write(&path, [&whole[..], b"\n"].concat()).unwrap();
    assert!(matches!(
        CheckpointReader::open(&path).unwrap_err(),
        CheckpointError::Trailing { excess: 1, .. }
    ));
}

#[test]
fn wrong_questions_are_answered_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("asked");
    small(&path);
    let reader = CheckpointReader::open(&path).unwrap();
    let error = reader.get::<f64>("stress").unwrap_err();
    assert!(
        matches!(&error, CheckpointError::Missing { section, .. } if section == "stress"),
        "{error}"
    );
    let error = reader.get::<u32>("velocity").unwrap_err().to_string();
    assert!(
        error.contains("'velocity'") && error.contains("[f64; 2]") && error.contains("u32"),
        "{error}"
    );
    assert!(
        matches!(
            reader.get_value::<u64>("clock").unwrap_err(),
            CheckpointError::Decode { .. }
        ),
        "bytes left over"
    );
    assert!(matches!(
        reader.get_value::<(u64, f64, f64)>("clock").unwrap_err(),
        CheckpointError::Decode { .. }
    ));

    let mut writer = CheckpointWriter::new();
    let error = writer
        .put("ids", &[1_u32])
        .unwrap()
        .put("ids", &[2_u32])
        .unwrap_err();
    assert!(
        matches!(&error, CheckpointError::Duplicate { section } if section == "ids"),
        "{error}"
    );
    assert!(matches!(
        CheckpointReader::open(folder.path().join("none")).unwrap_err(),
        CheckpointError::File(_)
    ));
}

#[test]
fn a_reader_outlives_the_next_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("state");
    small(&path);
    let reader = CheckpointReader::open(&path).unwrap();
    CheckpointWriter::new()
        .put("ids", &[9_u32])
        .unwrap()
        .write(&path)
        .unwrap();
    #[cfg(unix)]
    assert_eq!(reader.get::<u32>("ids").unwrap(), [7, 0, 4711]);
    assert_eq!(
        CheckpointReader::open(&path)
            .unwrap()
            .get::<u32>("ids")
            .unwrap(),
        [9]
    );
    drop(reader);
    assert_eq!(
        fs::read_dir(folder.path()).unwrap().count(),
        1,
        "no temporary file stays behind"
    );
}
