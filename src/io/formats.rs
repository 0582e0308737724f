//! The list of all formats.

use super::format::{Format, FormatInfo};
use super::mesh_data::MeshFormat;
use super::{esri, freesurfer, gifti, gltf, gmsh, obj, off, ply, stl, vtk, vtkxml};

/// Makes of one list what is asked of it: the constant of each format, and what users are told.
macro_rules! list {
    ($($variant:ident => $format:expr),* $(,)?) => {
        impl MeshFormat {
            /// What there is of a format.
            pub(super) const fn format(self) -> &'static Format {
                match self {
                    $(Self::$variant => &$format,)*
                }
            }
        }

        const INFO: &[FormatInfo] = &[
            $($format.info(),)*
            table("csv", &["csv", "tsv"], "Columns with commas, semicolons, tabs or bars between them, with or without a header"),
            table("txt", &["txt", "xyz", "dat"], "Columns or numbers with blanks between them"),
            table("npy", &["npy"], "Arrays of NumPy"),
            table("curv", &["curv", "thickness", "sulc", "area"], "Values of FreeSurfer, one per vertex"),
        ];
    };
}
list! {
    Obj => obj::FORMAT,
    Off => off::FORMAT,
    Ply => ply::FORMAT,
    Stl => stl::FORMAT,
    Vtk => vtk::FORMAT,
    Vtp => vtkxml::VTP,
    Vtu => vtkxml::VTU,
    Glb => gltf::FORMAT,
    Msh => gmsh::FORMAT,
    Gii => gifti::FORMAT,
    FreeSurfer => freesurfer::FORMAT,
    Asc => esri::FORMAT,
}

const fn table(name: &'static str, extensions: &'static [&'static str], description: &'static str) -> FormatInfo {
    FormatInfo { name, extensions, reads: true, writes: false, description }
}

/// All formats: those of meshes, then those of fields and tables.
#[must_use]
pub fn formats() -> &'static [FormatInfo] {
    INFO
}

/// The format that the content shows. Those that show themselves least are first in the list and are asked last.
pub(super) fn sniff(bytes: &[u8]) -> Option<MeshFormat> {
    MeshFormat::ALL.iter().rev().copied().find(|format| (format.format().sniff)(bytes))
}

/// The format of files with such a name.
pub(super) fn of_file_name(name: &str) -> Option<MeshFormat> {
    let name = name.strip_suffix(".gz").unwrap_or(name);
    let ending = name.rsplit_once('.')?.1;
    let has_ending =
        |format: &&MeshFormat| format.format().extensions.iter().any(|own| own.eq_ignore_ascii_case(ending));
    MeshFormat::ALL.iter().find(has_ending).copied()
}
