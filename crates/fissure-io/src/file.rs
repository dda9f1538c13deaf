//! Files that are whole or absent: everything but a streamed table is written beside its final name and renamed over it.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Something the operating system refused, with the file it was about.
#[derive(Debug, thiserror::Error)]
#[error("cannot {action} '{}'", path.display())]
#[non_exhaustive]
pub struct FileError {
    /// What was being done, as a verb: "create", "write", "open", "read" or "rename to".
    pub action: &'static str,
    /// The file or folder it was done to.
    pub path: PathBuf,
    /// What the operating system answered.
    #[source]
    pub source: io::Error,
}

impl FileError {
    /// The closure `map_err` wants, so that every call site names its file in one word.
    pub(crate) fn on(action: &'static str, path: &Path) -> impl Fn(io::Error) -> Self {
        move |source| Self {
            action,
            path: path.to_owned(),
            source,
        }
    }
}

/// What a file must survive once its writer has returned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Survive {
    /// The end of this process: enough for output that can be computed again.
    Process,
    /// A power failure: the file and its folder entry are on the disk. Costs a flush of the disk's cache.
    PowerFailure,
}

/// Writes a file through `fill` so that, whatever happens meanwhile, `path` holds the old content or the whole new one.
/// The folder must exist. Permissions are those of any new file (0644 under the usual umask), not a temporary file's 0600.
pub(crate) fn replace(
    path: &Path,
    survive: Survive,
    fill: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), FileError> {
    // The rename is atomic only within one file system, hence the same folder and not the system's temporary one.
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".fissure-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The system takes the umask off, as it does for `File::create`.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut temporary = builder
        .tempfile_in(folder)
        .map_err(FileError::on("create", path))?;

    let mut writer = BufWriter::with_capacity(1 << 20, temporary.as_file_mut());
    fill(&mut writer)
        .and_then(|()| writer.flush())
        .map_err(FileError::on("write", path))?;
    drop(writer);
    if survive == Survive::PowerFailure {
        temporary
            .as_file()
            .sync_all()
            .map_err(FileError::on("write", path))?;
    }
    temporary
        .persist(path)
        .map_err(|refused| FileError::on("rename to", path)(refused.error))?;
    if survive == Survive::PowerFailure {
        sync_folder(folder)?;
    }
    Ok(())
}

/// Creates a folder and its parents; one that exists is fine.
pub(crate) fn create_folder(folder: &Path) -> Result<(), FileError> {
    fs::create_dir_all(folder).map_err(FileError::on("create", folder))
}

/// A rename lives in the folder: without this it can be lost although the file's bytes are safe.
#[cfg(unix)]
fn sync_folder(folder: &Path) -> Result<(), FileError> {
    File::open(folder)
        .and_then(|opened| opened.sync_all())
        .map_err(FileError::on("write", folder))
}

/// Elsewhere folders cannot be opened as files; the system's own journal has to do.
#[cfg(not(unix))]
fn sync_folder(_folder: &Path) -> Result<(), FileError> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("state.bin");
        replace(&path, Survive::PowerFailure, |out| out.write_all(b"old")).unwrap();
        let error = replace(&path, Survive::PowerFailure, |out| {
            out.write_all(b"half of the new")?;
            Err(io::Error::other("disk full"))
        })
        .unwrap_err();
        assert_eq!(error.action, "write");
        assert!(error.to_string().contains("state.bin"), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(
            fs::read_dir(folder.path()).unwrap().count(),
            1,
            "no temporary file stays behind"
        );
    }

    #[cfg(unix)]
    #[test]
    fn permissions_are_those_of_an_ordinary_file() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (ours, ordinary) = (folder.path().join("ours"), folder.path().join("ordinary"));
        replace(&ours, Survive::Process, |out| out.write_all(b"x")).unwrap();
        fs::write(&ordinary, b"x").unwrap();
        let mode = |path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&ordinary));
    }

    #[test]
    fn a_missing_folder_is_an_error_that_names_the_file() {
        let error = replace(Path::new("no/such/folder/file"), Survive::Process, |_| {
            Ok(())
        })
        .unwrap_err();
        assert!(error.to_string().contains("no/such/folder/file"), "{error}");
    }
}
