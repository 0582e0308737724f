"""Makes the files of tests/golden/files with other programs, and what these programs say of them.

    python3 -m venv target/peers && target/peers/bin/pip install vtk meshio nibabel gmsh trimesh numpy
    target/peers/bin/python scripts/make-file-fixtures.py && npx prettier --write tests/golden/files/expected.json

Every file has its row in expected.json beside it: counts, bounds, and the sum of every field, all as the program reads them back (or,
where it only writes, as they were given to it). The tests compare with these. Run it again only to add files: the bytes of some
programs have a date in them.
"""

import gzip
import json
import struct
from pathlib import Path

import gmsh
import meshio
import nibabel
import numpy as np
import trimesh
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

FOLDER = Path(__file__).parent.parent / "tests" / "golden" / "files"
expected = {}


def note(name, points, triangles, fields=None, triangle_fields=None, area=None):
    """What a file holds. Triangles may be None where only the area is comparable."""
    points = np.asarray(points, float)
    row = {
        "vertices": len(points),
        "bounds": [points.min(axis=0).tolist(), points.max(axis=0).tolist()],
        "fields": {key: float(np.sum(np.asarray(value, float))) for key, value in (fields or {}).items()},
        "triangleFields": {key: float(np.sum(np.asarray(value, float))) for key, value in (triangle_fields or {}).items()},
    }
    if triangles is not None:
        triangles = np.asarray(triangles, int)
        row["triangles"] = len(triangles)
        a, b, c = (points[triangles[:, i]] for i in range(3))
        area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()
    row["area"] = float(area)
    expected[name] = row


def note_table(name, columns):
    expected[name] = {"columns": {key: [len(v), float(np.nansum(v)), int(np.isnan(v).sum())] for key, v in columns.items()}}


def torus(n=9, m=6):
    u, v = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    points = np.stack([(2 + 0.7 * np.cos(v)) * np.cos(u), (2 + 0.7 * np.cos(v)) * np.sin(u), 0.7 * np.sin(v) + 0.1 * np.cos(3 * u)], -1)
    at = lambda i, j: (i % n) * m + j % m
    triangles = [t for i in range(n) for j in range(m) for t in
                 ([at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)])]
    return points.reshape(-1, 3), np.array(triangles)


P, T = torus()
HEIGHT = P[:, 2] * 3 + 0.25
LOAD = np.arange(len(T)) * 0.5 - 3
PULL = np.stack([P[:, 0], -P[:, 1], P[:, 2] * 0 + 2], -1)


def poly_data():
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(P, deep=True))
    data.SetPoints(points)
    cells = vtk.vtkCellArray()
    for t in T:
        cells.InsertNextCell(3, [int(i) for i in t])
    data.SetPolys(cells)
    for owner, name, values in ((data.GetPointData(), "height", HEIGHT), (data.GetPointData(), "pull", PULL),
                                (data.GetPointData(), "label", np.arange(len(P), dtype=np.int32)), (data.GetCellData(), "load", LOAD)):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        owner.AddArray(array)
    return data


def note_poly(name):
    note(name, P, T, {"height": HEIGHT, "pull_0": PULL[:, 0], "pull_1": PULL[:, 1], "pull_2": PULL[:, 2],
                      "pull_magnitude": np.linalg.norm(PULL, axis=1), "label": np.arange(len(P))}, {"load": LOAD})


def write_xml(writer, name, data, mode, compressor=None, header=32, big=False, encode=True):
    writer.SetFileName(str(FOLDER / name))
    writer.SetInputData(data)
    getattr(writer, f"SetDataModeTo{mode}")()
    writer.SetCompressor(vtk.vtkZLibDataCompressor() if compressor else None)
    if compressor:
        # Several blocks for each array.
        writer.SetBlockSize(256)
    getattr(writer, f"SetHeaderTypeToUInt{header}")()
    getattr(writer, f"SetByteOrderTo{'Big' if big else 'Little'}Endian")()
    if mode == "Appended":
        writer.SetEncodeAppendedData(encode)
    assert writer.Write()


def xml_files():
    variants = [("ascii", dict(mode="Ascii")), ("base64", dict(mode="Binary")), ("base64-zlib", dict(mode="Binary", compressor=True)),
                ("raw", dict(mode="Appended", encode=False)), ("raw-zlib-64", dict(mode="Appended", encode=False, compressor=True, header=64)),
                ("encoded-big", dict(mode="Appended", big=True)), ("encoded-zlib-big-64", dict(mode="Appended", compressor=True, big=True, header=64))]
    for name, options in variants:
        write_xml(vtk.vtkXMLPolyDataWriter(), f"torus-{name}.vtp", poly_data(), **options)
        note_poly(f"torus-{name}.vtp")
        write_xml(vtk.vtkXMLUnstructuredGridWriter(), f"block-{name}.vtu", block(), **options)
        note_block(f"block-{name}.vtu")
    # Lines before and strips after the polygons, with values for all.
    data = poly_data()
    lines = vtk.vtkCellArray()
    lines.InsertNextCell(2, [0, 1])
    data.SetLines(lines)
    strips = vtk.vtkCellArray()
    strips.InsertNextCell(5, [0, 6, 1, 7, 2])
    data.SetStrips(strips)
    values = np.concatenate([[1000.0], np.arange(len(T)), [7.0]])
    array = numpy_to_vtk(values, deep=True)
    array.SetName("kind")
    data.GetCellData().RemoveArray("load")
    data.GetCellData().AddArray(array)
    write_xml(vtk.vtkXMLPolyDataWriter(), "torus-strips.vtp", data, "Ascii")
    strip = [[0, 6, 1], [1, 6, 7], [1, 7, 2]]
    fields = {"height": HEIGHT, "label": np.arange(len(P))}
    note("torus-strips.vtp", P, np.concatenate([T, strip]), fields, {"kind": np.concatenate([np.arange(len(T)), [7, 7, 7]])})


def block():
    """Every kind of cell that fills a volume: a hexahedron, a voxel, a wedge, a pyramid and two tetrahedra, in a row."""
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1),
              (2, 0, 0), (2, 1, 0), (2, 0, 1), (2, 1, 1), (3, 0, 0), (3, 1, 0), (3.5, .5, .5), (2.5, .5, 2), (9, 9, 9)]
    grid = vtk.vtkUnstructuredGrid()
    vtk_points = vtk.vtkPoints()
    vtk_points.SetDataTypeToDouble()
    vtk_points.SetData(numpy_to_vtk(np.array(points, float), deep=True))
    grid.SetPoints(vtk_points)
    cells = [(vtk.VTK_HEXAHEDRON, [0, 1, 2, 3, 4, 5, 6, 7]), (vtk.VTK_VOXEL, [1, 8, 2, 9, 5, 10, 6, 11]),
             (vtk.VTK_WEDGE, [8, 10, 12, 9, 11, 13]), (vtk.VTK_PYRAMID, [10, 11, 13, 12, 14]),
             (vtk.VTK_TETRA, [10, 11, 14, 15]), (vtk.VTK_TETRA, [5, 10, 11, 15]), (vtk.VTK_LINE, [0, 16])]
    for kind, ids in cells:
        grid.InsertNextCell(kind, len(ids), ids)
    for owner, name, values in ((grid.GetPointData(), "heat", np.arange(len(points)) * 0.5), (grid.GetCellData(), "kind", np.arange(len(cells)) + 1.0)):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        owner.AddArray(array)
    return grid


def note_block(name):
    # What VTK itself finds to be the outer surface.
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(block())
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(surface.GetOutputPort())
    triangles.PassLinesOff()
    triangles.PassVertsOff()
    triangles.Update()
    data = triangles.GetOutput()
    points = vtk_to_numpy(data.GetPoints().GetData())
    ids = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    used = np.unique(ids)
    new = np.full(len(points), -1)
    new[used] = np.arange(len(used))
    note(name, points[used], new[ids], {"heat": vtk_to_numpy(data.GetPointData().GetArray("heat"))[used]},
         {"kind": vtk_to_numpy(data.GetCellData().GetArray("kind"))})


def legacy_files():
    for binary in (False, True):
        for version in (42, 51):
            name = f"torus-{'binary' if binary else 'ascii'}-{version}.vtk"
            writer = vtk.vtkPolyDataWriter()
            writer.SetFileVersion(version)
            writer.SetFileName(str(FOLDER / name))
            writer.SetInputData(poly_data())
            writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
            writer.Write()
            note_poly(name)
            name = name.replace("torus", "block")
            writer = vtk.vtkUnstructuredGridWriter()
            writer.SetFileVersion(version)
            writer.SetFileName(str(FOLDER / name))
            writer.SetInputData(block())
            writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
            writer.Write()
            note_block(name)
    grids()


def surface_of(data):
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(data)
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(surface.GetOutputPort())
    # The sides of a block have points of their own there.
    clean = vtk.vtkCleanPolyData()
    clean.SetTolerance(0)
    clean.SetInputConnection(triangles.GetOutputPort())
    clean.Update()
    out = clean.GetOutput()
    points = vtk_to_numpy(out.GetPoints().GetData()).astype(float)
    ids = vtk_to_numpy(out.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    names = lambda owner: {owner.GetArrayName(i): vtk_to_numpy(owner.GetArray(i)) for i in range(owner.GetNumberOfArrays())}
    return points, ids, names(out.GetPointData()), names(out.GetCellData())


def grids():
    image = vtk.vtkImageData()
    image.SetDimensions(4, 3, 1)
    image.SetOrigin(1, 2, 3)
    image.SetSpacing(0.5, 0.25, 1)
    rectilinear = vtk.vtkRectilinearGrid()
    rectilinear.SetDimensions(3, 4, 3)
    for axis, values in zip("XYZ", ([0, 1, 3], [0, 0.5, 1, 4], [-1, 0, 2])):
        getattr(rectilinear, f"Set{axis}Coordinates")(numpy_to_vtk(np.array(values, float), deep=True))
    structured = vtk.vtkStructuredGrid()
    structured.SetDimensions(5, 4, 1)
    u, v = np.meshgrid(np.arange(5.0), np.arange(4.0))
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(np.stack([u, v, u * u * 0.1], -1).reshape(-1, 3), deep=True))
    structured.SetPoints(points)
    for name, data, writer in (("image", image, vtk.vtkStructuredPointsWriter()), ("rectilinear", rectilinear, vtk.vtkRectilinearGridWriter()),
                               ("structured", structured, vtk.vtkStructuredGridWriter())):
        for owner, array, count in ((data.GetPointData(), "height", data.GetNumberOfPoints()), (data.GetCellData(), "cell", data.GetNumberOfCells())):
            values = numpy_to_vtk(np.arange(count) * 0.5, deep=True)
            values.SetName(array)
            owner.AddArray(values)
        writer.SetFileName(str(FOLDER / f"{name}.vtk"))
        writer.SetInputData(data)
        writer.SetFileTypeToBinary()
        writer.Write()
        surface, ids, fields, cells = surface_of(data)
        # VTK keeps the points inside of a block out, too.
        note(f"{name}.vtk", surface, ids, {"height": fields["height"]}, {"cell": cells["cell"]})


def meshio_files():
    mesh = meshio.Mesh(P, [("triangle", T)], point_data={"height": HEIGHT}, cell_data={"load": [LOAD]})
    for name, form, options in (("meshio.vtu", "vtu", {}), ("meshio-ascii.vtu", "vtu", {"binary": False}), ("meshio.ply", "ply", {}),
                                ("meshio-ascii.ply", "ply", {"binary": False}), ("meshio.vtk", "vtk", {}),
                                ("meshio-2.msh", "gmsh22", {}),
                                ("meshio-4.msh", "gmsh", {}), ("meshio.off", "off", {}), ("meshio.obj", "obj", {})):
        path = FOLDER / name
        plain = meshio.Mesh(P, [("triangle", T)])
        meshio.write(path, plain if form in ("off", "obj") else mesh, file_format=form, **options)
        back = meshio.read(path)
        fields = {} if form in ("off", "obj") else {"height": HEIGHT}
        cells = {} if form in ("off", "obj", "ply") else {"load": LOAD}
        assert len(back.points) == len(P) and len(back.cells_dict["triangle"]) == len(T)
        note(name, back.points, back.cells_dict["triangle"], fields, cells)


def stl_files():
    mesh = trimesh.Trimesh(P, T, process=False)
    (FOLDER / "trimesh.stl").write_bytes(mesh.export(file_type="stl"))
    (FOLDER / "trimesh-ascii.stl").write_text(mesh.export(file_type="stl_ascii"))
    for name in ("trimesh.stl", "trimesh-ascii.stl"):
        back = trimesh.load(FOLDER / name, process=False)
        merged = trimesh.Trimesh(back.vertices, back.faces, process=False)
        merged.merge_vertices(digits_vertex=12)
        note(name, merged.vertices, merged.faces)


def glb_files():
    mesh = trimesh.Trimesh(P, T, process=False)
    mesh.vertex_attributes["_HEIGHT"] = HEIGHT.astype(np.float32)
    scene = trimesh.Scene()
    move = trimesh.transformations.rotation_matrix(0.3, [1, 2, 3]) @ np.diag([2.0, 2, 2, 1])
    move[:3, 3] = [1, 2, 3]
    scene.add_geometry(mesh, transform=move)
    other = np.eye(4)
    other[:3, 3] = [10, 0, 0]
    scene.add_geometry(trimesh.Trimesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], process=False), transform=other)
    (FOLDER / "trimesh.glb").write_bytes(scene.export(file_type="glb"))
    points = np.concatenate([trimesh.transformations.transform_points(P.astype(np.float32), move), [[10, 0, 0], [11, 0, 0], [10, 1, 0]]])
    note("trimesh.glb", points, np.concatenate([T, [[len(P), len(P) + 1, len(P) + 2]]]))
    expected["trimesh.glb"]["someFields"] = {"HEIGHT": float(HEIGHT.astype(np.float32).astype(float).sum())}


def brain_files():
    image = nibabel.gifti
    for name, encoding, order in (("gzip", "GIFTI_ENCODING_B64GZ", "C"), ("base64", "GIFTI_ENCODING_B64BIN", "C"), ("ascii", "GIFTI_ENCODING_ASCII", "C"), ("columns", "GIFTI_ENCODING_B64GZ", "F")):
        arrays = [image.GiftiDataArray(P.astype(np.float32), "NIFTI_INTENT_POINTSET", encoding=encoding, ordering=order),
                  image.GiftiDataArray(T.astype(np.int32), "NIFTI_INTENT_TRIANGLE", encoding=encoding, ordering=order)]
        nibabel.save(image.GiftiImage(darrays=arrays), FOLDER / f"torus-{name}.surf.gii")
        back = nibabel.load(FOLDER / f"torus-{name}.surf.gii")
        note(f"torus-{name}.surf.gii", back.darrays[0].data, back.darrays[1].data)
        meta = image.GiftiMetaData({"Name": "height"})
        arrays = [image.GiftiDataArray(HEIGHT.astype(np.float32), "NIFTI_INTENT_SHAPE", encoding=encoding, meta=meta),
                  image.GiftiDataArray(np.arange(len(P), dtype=np.int32), "NIFTI_INTENT_LABEL", encoding=encoding)]
        nibabel.save(image.GiftiImage(darrays=arrays), FOLDER / f"torus-{name}.shape.gii")
        back = nibabel.load(FOLDER / f"torus-{name}.shape.gii")
        note_table(f"torus-{name}.shape.gii", {"height": back.darrays[0].data.astype(float), "label": back.darrays[1].data.astype(float)})
    nibabel.freesurfer.write_geometry(FOLDER / "lh.white", P, T, create_stamp="made by nibabel")
    points, triangles = nibabel.freesurfer.read_geometry(FOLDER / "lh.white")
    note("lh.white", points, triangles)
    nibabel.freesurfer.write_morph_data(FOLDER / "lh.curv", HEIGHT)
    note_table("lh.curv", {"value": nibabel.freesurfer.read_morph_data(FOLDER / "lh.curv").astype(float)})


def numpy_files():
    table = np.stack([P[:, 0], HEIGHT, np.where(np.arange(len(P)) % 7 == 0, np.nan, P[:, 1])], -1)
    for name, array in (("f8", HEIGHT), ("f4-big", HEIGHT.astype(">f4")), ("f2", HEIGHT.astype(np.float16)), ("i8", np.arange(20) - 5),
                        ("bool", np.arange(20) % 3 == 0), ("u2", np.arange(20, dtype=np.uint16) * 3000), ("column", HEIGHT.reshape(-1, 1)), ("row", HEIGHT.reshape(1, -1))):
        np.save(FOLDER / f"{name}.npy", array)
        note_table(f"{name}.npy", {"0": np.load(FOLDER / f"{name}.npy").astype(float).ravel()})
    for name, array in (("table", table), ("fortran", np.asfortranarray(table.astype("<f4")))):
        np.save(FOLDER / f"{name}.npy", array)
        note_table(f"{name}.npy", {str(i): array[:, i].astype(float) for i in range(3)})
    records = np.zeros(5, [("id", "<i4"), ("height", "<f8")])
    records["id"], records["height"] = np.arange(5), np.arange(5) * 0.25
    np.save(FOLDER / "records.npy", records)
    note_table("records.npy", {"id": np.arange(5.0), "height": np.arange(5) * 0.25})
    np.savetxt(FOLDER / "numpy.txt", table, header="x height y")
    note_table("numpy.txt", {"x": table[:, 0], "height": table[:, 1], "y": table[:, 2]})
    (FOLDER / "numpy.txt.gz").write_bytes(gzip.compress((FOLDER / "numpy.txt").read_bytes(), mtime=0))
    note_table("numpy.txt.gz", {"x": table[:, 0], "height": table[:, 1], "y": table[:, 2]})


def gmsh_files():
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.option.setNumber("Mesh.MeshSizeMin", 2)
    gmsh.model.mesh.generate(3)
    # The surface of the box, as Gmsh has meshed it.
    _, _, nodes = gmsh.model.mesh.getElements(2)
    surface = np.concatenate(nodes).reshape(-1, 3)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    where = dict(zip(tags, coordinates.reshape(-1, 3)))
    used = np.unique(surface)
    ids = {tag: i for i, tag in enumerate(used)}
    points = np.array([where[tag] for tag in used])
    triangles = np.vectorize(ids.get)(surface)
    for name, version, binary in (("gmsh-2.msh", 2.2, 0), ("gmsh-2-binary.msh", 2.2, 1), ("gmsh-4.msh", 4.1, 0), ("gmsh-4-binary.msh", 4.1, 1)):
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", binary)
        gmsh.option.setNumber("Mesh.SaveAll", 1)
        gmsh.write(str(FOLDER / name))
        note(name, points, triangles)
    gmsh.finalize()


def grid_files():
    heights = np.arange(20.0).reshape(4, 5) * 0.5
    heights[1, 2] = -9999
    rows = "\n".join(" ".join(str(value) for value in row) for row in heights)
    head = "ncols 5\nnrows 4\nxllcorner 100\nyllcorner 200\ncellsize 10\nNODATA_value -9999\n"
    (FOLDER / "grid.asc").write_text(f"{head}{rows}\n")
    # VTK reads these grids, too, but only without missing cells; here by hand.
    points = [(100 + 10 * (j + 0.5), 200 + 10 * (3 - i + 0.5), heights[i, j]) for i in range(4) for j in range(5) if heights[i, j] != -9999]
    note("grid.asc", points, None, {"height": [p[2] for p in points]}, area=0)
    # Twelve squares, of which four have lost a corner and become triangles.
    expected["grid.asc"]["triangles"] = 8 * 2 + 4
    del expected["grid.asc"]["area"]


def main():
    FOLDER.mkdir(parents=True, exist_ok=True)
    for old in FOLDER.iterdir():
        old.unlink()
    xml_files()
    legacy_files()
    meshio_files()
    stl_files()
    glb_files()
    brain_files()
    numpy_files()
    gmsh_files()
    grid_files()
    (FOLDER / "torus.stl.gz").write_bytes(gzip.compress((FOLDER / "trimesh.stl").read_bytes(), mtime=0))
    expected["torus.stl.gz"] = expected["trimesh.stl"]
    (FOLDER / "expected.json").write_text(json.dumps(expected, indent=1) + "\n")


if __name__ == "__main__":
    main()
