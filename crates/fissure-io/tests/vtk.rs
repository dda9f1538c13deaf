//! Point clouds read back by the small reader of [`support`].
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "helpers of tests are tests"
)]

mod support;

use std::fs;

use fissure_io::vtk::{Compression, PointCloud, Series, VtkError};

use support::vtu::{attribute, read};

/// Columns of every kind with awkward bits in them.
struct Columns {
    points: Vec<[f64; 3]>,
    scalar: Vec<f64>,
    symmetric: Vec<[f64; 6]>,
    tensor: Vec<[[f64; 3]; 3]>,
    ids: Vec<u32>,
}

impl Columns {
    fn new(count: usize) -> Self {
        let number = |index: usize, component: usize| ((index * 9 + component) as f64).sin() * 1e-3;
        let mut scalar: Vec<f64> = (0..count).map(|index| number(index, 7)).collect();
        let odd = [
            f64::NAN,
            f64::from_bits(0x7ff8_0000_dead_beef),
            -0.0,
            f64::NEG_INFINITY,
            f64::MIN_POSITIVE / 4.0,
        ];
        for (value, odd) in scalar.iter_mut().zip(odd) {
            *value = odd;
        }
        Self {
            points: (0..count)
                .map(|index| [index as f64, number(index, 0), 0.0])
                .collect(),
            scalar,
            symmetric: (0..count)
                .map(|index| std::array::from_fn(|part| number(index, part)))
                .collect(),
            tensor: (0..count)
                .map(|index| {
                    [
                        [1.0, number(index, 0), 0.0],
                        [0.0, 1.0, 0.0],
                        [0.5, 0.0, 1.0],
                    ]
                })
                .collect(),
            ids: (0..count as u32)
                .map(|index| index.wrapping_mul(2_654_435_761))
                .collect(),
        }
    }

    fn cloud(&self) -> PointCloud<'_> {
        PointCloud::new(&self.points)
            .scalar("damage <\"d\"> & 'more'", &self.scalar)
            .vector("velocity [m/s]", &self.points)
            .symmetric("stress [Pa]", &self.symmetric)
            .tensor("F", &self.tensor)
            .ids("id", &self.ids)
    }
}

#[test]
fn every_bit_is_where_the_offsets_say() {
    let folder = tempfile::tempdir().unwrap();
    // Sizes around the 64 KiB block: none, one, a partial block, exactly one block of scalars, several.
    for count in [0, 1, 5, 1000, 8192, 8193, 30_000] {
        for compression in [Compression::None, Compression::Lz4] {
            let columns = Columns::new(count);
            let path = folder.path().join("cloud.vtu");
            columns
                .cloud()
                .time(1.3e-4)
                .write(&path, compression)
                .unwrap();
            let document = read(&path);
            assert_eq!(document.points, count);
            assert_eq!(document.time, Some(1.3e-4));

            let indices: Vec<i64> = (0..=count as i64).collect();
            let expected: [(&str, &str, usize, &[u8]); 9] = [
                (
                    "Points",
                    "Float64",
                    3,
                    bytemuck::cast_slice(&columns.points),
                ),
                (
                    "damage &lt;&quot;d&quot;&gt; &amp; &apos;more&apos;",
                    "Float64",
                    1,
                    bytemuck::cast_slice(&columns.scalar),
                ),
                (
                    "velocity [m/s]",
                    "Float64",
                    3,
                    bytemuck::cast_slice(&columns.points),
                ),
                (
                    "stress [Pa]",
                    "Float64",
                    6,
                    bytemuck::cast_slice(&columns.symmetric),
                ),
                ("F", "Float64", 9, bytemuck::cast_slice(&columns.tensor)),
                ("id", "UInt32", 1, bytemuck::cast_slice(&columns.ids)),
                (
                    "connectivity",
                    "Int64",
                    1,
                    bytemuck::cast_slice(&indices[..count]),
                ),
                ("offsets", "Int64", 1, bytemuck::cast_slice(&indices[1..])),
                ("types", "UInt8", 1, &vec![1; count]),
            ];
            assert_eq!(document.arrays.len(), expected.len());
            for (name, vtk_type, components, bytes) in expected {
                let array = document
                    .arrays
                    .get(name)
                    .unwrap_or_else(|| panic!("no array {name}"));
                assert_eq!(
                    (array.vtk_type.as_str(), array.components),
                    (vtk_type, components),
                    "{name}"
                );
                assert!(
                    array.bytes == bytes,
                    "{name} of {count} points, {compression:?}"
                );
            }
        }
    }
}

#[test]
fn constant_columns_are_packed() {
    let folder = tempfile::tempdir().unwrap();
    let (points, damage) = (vec![[0.0; 3]; 10_000], vec![0.0; 10_000]);
    let size = |name: &str, compression| {
        let path = folder.path().join(name);
        PointCloud::new(&points)
            .scalar("damage", &damage)
            .write(&path, compression)
            .unwrap();
        fs::metadata(path).unwrap().len()
    };
    let (packed, plain) = (
        size("packed.vtu", Compression::Lz4),
        size("plain.vtu", Compression::None),
    );
    assert!(4 * packed < plain, "{packed} of {plain} bytes");
}

#[test]
fn a_wrong_cloud_is_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wrong.vtu");
    let points = [[0.0; 3]; 2];
    let write = |cloud: PointCloud<'_>| cloud.write(&path, Compression::None).unwrap_err();
    let error = write(PointCloud::new(&points).scalar("damage", &[0.0]));
    assert!(
        matches!(&error, VtkError::Length { array, found: 1, points: 2, .. } if array == "damage"),
        "{error}"
    );
    assert!(error.to_string().contains("wrong.vtu"), "{error}");
    let error = write(
        PointCloud::new(&points)
            .ids("id", &[0, 1])
            .ids("id", &[0, 1]),
    );
    assert!(matches!(error, VtkError::Duplicate { .. }), "{error}");
    for name in ["", "a\nb"] {
        let error = write(PointCloud::new(&points).ids(name, &[0, 1]));
        assert!(matches!(error, VtkError::ArrayName { .. }), "{error}");
    }
    assert!(!path.exists());
}

/// Times and files the index lists.
fn listed(series: &Series) -> Vec<(f64, String)> {
    let text = fs::read_to_string(series.index_path()).unwrap();
    let frames = text.lines().filter(|line| line.contains("<DataSet"));
    frames
        .map(|line| {
            (
                attribute(line, "timestep").unwrap().parse().unwrap(),
                attribute(line, "file").unwrap().to_owned(),
            )
        })
        .collect()
}

#[test]
fn the_index_lists_every_frame_after_each() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().join("out/frames");
    let mut series = Series::new(&folder, "bar", Compression::None).unwrap();
    assert!(
        series.is_empty() && !folder.exists(),
        "nothing is written unasked"
    );
    for (index, time) in [0.0, 0.1 + 0.2, 1.0].into_iter().enumerate() {
        let path = series
            .write(time, PointCloud::new(vec![[time; 3]; 3]))
            .unwrap();
        let frames = listed(&series);
        assert_eq!(frames.len(), index + 1);
        assert_eq!(frames[index], (time, format!("bar_{index:06}.vtu")));
        assert_eq!(read(&path).time, Some(time));
    }
    // A frame at the same time replaces the last one.
    series
        .write(1.0, PointCloud::new(vec![[0.0; 3]; 7]))
        .unwrap();
    assert_eq!((series.len(), listed(&series).len()), (3, 3));
    assert_eq!(read(&folder.join("bar_000002.vtu")).points, 7);
    for time in [0.5, f64::NAN, f64::INFINITY] {
        let error = series.write(time, PointCloud::new(vec![])).unwrap_err();
        assert!(matches!(error, VtkError::Time { last: 1.0, .. }), "{error}");
    }
    assert_eq!(
        fs::read_dir(&folder).unwrap().count(),
        4,
        "three frames, the index, nothing temporary"
    );
}

#[test]
fn a_series_goes_on_from_a_checkpoints_time() {
    let folder = tempfile::tempdir().unwrap();
    let mut first = Series::new(folder.path(), "a&b", Compression::Lz4).unwrap();
    for time in [0.0, 1.0, 2.0, 3.0] {
        first.write(time, PointCloud::new(vec![[time; 3]])).unwrap();
    }
    let mut second = Series::resume(folder.path(), "a&b", Compression::Lz4, 1.5).unwrap();
    assert_eq!(second.len(), 2);
    second.write(1.75, PointCloud::new(vec![[0.0; 3]])).unwrap();
    let times: Vec<f64> = listed(&second).iter().map(|frame| frame.0).collect();
    assert_eq!(times, [0.0, 1.0, 1.75]);
    assert!(folder.path().join("a&b_000002.vtu").exists());

    fs::write(
        folder.path().join("odd.pvd"),
        "<VTKFile>\n<DataSet file=\"x.vtu\"/>\n",
    )
    .unwrap();
    let error = Series::resume(folder.path(), "odd", Compression::None, 0.0).unwrap_err();
    assert!(
        matches!(error, VtkError::Unreadable { line: 2, .. }),
        "{error}"
    );
    for name in ["", "a/b", "a\tb"] {
        let error = Series::new(folder.path(), name, Compression::None).unwrap_err();
        assert!(matches!(error, VtkError::SeriesName { .. }), "{error}");
    }
}
