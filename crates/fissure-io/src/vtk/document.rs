//! The XML around the numbers of a `.vtu`.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::io::{self, Write};

use super::appended::{Appended, Compression};
use super::cloud::PointCloud;

/// VTK's number for a cell that is one point.
const VTK_VERTEX: u8 = 1;

/// The machine's order, so that no number is turned around; VTK reads both.
pub(super) const BYTE_ORDER: &str = if cfg!(target_endian = "big") {
    "BigEndian"
} else {
    "LittleEndian"
};

/// Writes the whole document. The cloud has been checked.
pub(super) fn write(
    cloud: &PointCloud<'_>,
    compression: Compression,
    out: &mut impl Write,
) -> io::Result<()> {
    let mut appended = Appended::new(compression);
    let head = head(cloud, compression, &mut appended);
    out.write_all(head.as_bytes())?;
    appended.write(out)?;
    out.write_all(b"\n  </AppendedData>\n</VTKFile>\n")
}

/// Everything up to the underscore after which the appended bytes begin.
fn head<'a>(
    cloud: &'a PointCloud<'_>,
    compression: Compression,
    appended: &mut Appended<'a>,
) -> String {
    let count = cloud.points.len();
    let compressor = match compression {
        Compression::None => "",
        Compression::Lz4 => " compressor=\"vtkLZ4DataCompressor\"",
    };
    let mut xml = String::with_capacity(2048);
    let mut line = |depth: usize, text: &str| {
        xml.extend(std::iter::repeat_n("  ", depth));
        xml.push_str(text);
        xml.push('\n');
    };
    line(0, "<?xml version=\"1.0\"?>");
    line(
        0,
        &format!(
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{BYTE_ORDER}\" header_type=\"UInt64\"{compressor}>"
        ),
    );
    line(1, "<UnstructuredGrid>");
    if let Some(time) = cloud.time {
        line(2, "<FieldData>");
        line(
            3,
            &format!(
                "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{time:?}</DataArray>"
            ),
        );
        line(2, "</FieldData>");
    }
    line(
        2,
        &format!("<Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{count}\">"),
    );

    line(3, "<PointData>");
    for (name, values) in &cloud.arrays {
        let offset = appended.push(Cow::Borrowed(values.bytes()));
        line(
            4,
            &array(values.vtk_type(), name, values.components(), offset),
        );
    }
    line(3, "</PointData>");

    line(3, "<Points>");
    let offset = appended.push(Cow::Borrowed(bytemuck::cast_slice(&cloud.points)));
    line(4, &array("Float64", "Points", &["x", "y", "z"], offset));
    line(3, "</Points>");

    line(3, "<Cells>");
    let connectivity: Vec<i64> = (0..count as i64).collect();
    let offsets: Vec<i64> = (1..=count as i64).collect();
    for (name, values) in [("connectivity", connectivity), ("offsets", offsets)] {
        let offset = appended.push(Cow::Owned(bytemuck::cast_slice(&values).to_vec()));
        line(4, &array("Int64", name, &[], offset));
    }
    let offset = appended.push(Cow::Owned(vec![VTK_VERTEX; count]));
    line(4, &array("UInt8", "types", &[], offset));
    line(3, "</Cells>");

    line(2, "</Piece>");
    line(1, "</UnstructuredGrid>");
    line(1, "<AppendedData encoding=\"raw\">");
    xml.push_str("   _");
    xml
}

/// One array's element. Components are named so that no reader has to know VTK's order.
fn array(vtk_type: &str, name: &str, components: &[&str], offset: u64) -> String {
    let mut xml = format!("<DataArray type=\"{vtk_type}\" Name=\"{}\"", escape(name));
    if !components.is_empty() {
        // Writing to a String cannot fail.
        let _ = write!(xml, " NumberOfComponents=\"{}\"", components.len());
        for (index, component) in components.iter().enumerate() {
            let _ = write!(xml, " ComponentName{index}=\"{component}\"");
        }
    }
    let _ = write!(xml, " format=\"appended\" offset=\"{offset}\"/>");
    xml
}

/// The five characters that cannot stand in an attribute.
pub(super) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace('\'', "&apos;")
}

/// Undoes [`escape`].
pub(super) fn unescape(text: &str) -> String {
    text.replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&apos;", "'")
        .replace("&amp;", "&")
}
