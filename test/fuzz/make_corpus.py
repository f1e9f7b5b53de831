#!/usr/bin/env python3
"""Writes the inputs that the fuzz targets start from.

    make_corpus.py FOLDER    into FOLDER/<target>
"""
import pathlib
import random
import struct
import sys

POINTS = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 3.5)]
FACES = [(0, 1, 2), (0, 2, 3), (1, 2, 3)]


def rows(points, more=""):
    return "".join("%g %g %g%s\n" % (*point, more) for point in points)


def pcd(data, body, fields="x y z", sizes="4 4 4", types="F F F", counts="1 1 1"):
    return (
        "# .PCD v0.7\nVERSION 0.7\nFIELDS %s\nSIZE %s\nTYPE %s\nCOUNT %s\n"
        "WIDTH 4\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA %s\n"
        % (fields, sizes, types, counts, data)
    ).encode() + body


def ply(encoding, vertices, faces, properties="x y z", kind="float"):
    header = "ply\nformat %s 1.0\ncomment small\nelement vertex 4\n" % encoding
    header += "".join("property %s %s\n" % (kind, name) for name in properties.split())
    header += "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
    return header.encode() + vertices + faces


def packed(order, kind="f"):
    return b"".join(struct.pack(order + 3 * kind, *point) for point in POINTS)


def packed_faces(order):
    return b"".join(struct.pack(order + "Biii", 3, *face) for face in FACES)


def stl_facets():
    return "".join(
        "facet normal 0 0 1\nouter loop\n"
        + "".join("vertex %g %g %g\n" % POINTS[i] for i in face)
        + "endloop\nendfacet\n"
        for face in FACES
    )


def reader_inputs():
    """Of each format some files: name, extension's number in fuzz_readers, content."""
    text = rows(POINTS).encode()
    columns = b"".join(
        struct.pack("<4f", *(point[axis] for point in POINTS)) for axis in range(3)
    )
    # LZF: literals of up to 32 bytes
    compressed = b"".join(
        bytes([len(part) - 1]) + part
        for part in (columns[i : i + 32] for i in range(0, len(columns), 32))
    )
    sizes = struct.pack("<II", len(compressed), len(columns))
    face_rows = "".join("3 %d %d %d\n" % face for face in FACES)
    obj = "".join("v %g %g %g\n" % point for point in POINTS)
    obj_faces = "".join("f %d %d %d\n" % tuple(i + 1 for i in face) for face in FACES)
    stl_binary = b"\0" * 80 + struct.pack("<I", len(FACES))
    for face in FACES:
        stl_binary += struct.pack("<3f", 0, 0, 1)
        stl_binary += b"".join(struct.pack("<3f", *POINTS[i]) for i in face) + b"\0\0"

    yield "pcd_ascii", 0, pcd("ascii", text)
    yield "pcd_binary", 0, pcd("binary", packed("<"))
    yield "pcd_compressed", 0, pcd("binary_compressed", sizes + compressed)
    yield "pcd_double", 0, pcd("binary", packed("<", "d"), sizes="8 8 8")
    yield "pcd_colour", 0, pcd(
        "ascii", rows(POINTS, " 4278190335 nan").encode(), "x y z rgb curvature",
        "4 4 4 4 4", "F F F U F", "1 1 1 1 1")
    yield "pcd_counts", 0, pcd(
        "ascii", rows(POINTS, " 1 2 3").encode(), "x y z histogram", "4 4 4 2",
        "F F F U", "1 1 1 3")
    yield "ply_ascii", 1, ply("ascii", text, face_rows.encode())
    yield "ply_little", 1, ply("binary_little_endian", packed("<"), packed_faces("<"))
    yield "ply_big", 1, ply("binary_big_endian", packed(">"), packed_faces(">"))
    yield "ply_double", 1, ply(
        "binary_little_endian", packed("<", "d"), packed_faces("<"), kind="double")
    yield "ply_normals", 1, ply(
        "ascii", rows(POINTS, " 0 0 1").encode(), face_rows.encode(), "x y z nx ny nz")
    yield "off", 2, ("OFF\n4 3 0\n" + rows(POINTS) + face_rows).encode()
    yield "off_colours", 2, (
        "COFF\n# comment\n4 3 0\n" + rows(POINTS, " 255 0 0 255") + face_rows).encode()
    yield "text", 3, text
    yield "text_title", 3, b"x y z intensity\n" + rows(POINTS, " 7").encode()
    yield "text_count", 3, b"4\n" + text.replace(b" ", b", ")
    yield "text_names", 3, b"//X Y Z R G B Nx Ny Nz\n" + rows(
        POINTS, " 1 2 3 0 0 1").encode()
    yield "text_csv", 7, b'"id","x [m]","y [m]","z [m]","kind"\n' + b"".join(
        b'%d,"%g",%g,%g,oak\n' % (i, *point) for i, point in enumerate(POINTS))
    yield "text_german", 7, b"sep=;\nX;Y;Z\n" + (
        text.replace(b".", b",").replace(b" ", b";"))
    yield "text_utf16", 3, ("X\tY\tZ\r\n" + rows(POINTS)).encode("utf-16")
    yield "text_mac", 3, text.replace(b"\n", b"\r")
    yield "text_numbers", 3, b"1.5D+01 1.#QNAN 0.25-100\n1 2 nan\nNA 1 2\n1 2 3\n"
    yield "pts_blocks", 6, b"2\n1 2 3 -5 9 8 7\n4 5 6 0 1 2 3\n1\n7 8 9 1 1 2 3\n"
    scan = b"2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" \
        b"0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n"
    yield "ptx", 8, scan + rows(POINTS, " 0.5").encode()
    yield "ptx_colours", 8, 2 * (scan + rows(POINTS, " 0.5 1 2 3").encode())
    yield "off_glued", 2, ("OFF4 3 0\n" + rows(POINTS) + face_rows).encode()
    yield "off_tokens", 2, (
        "NOFF 4 3\n" + rows(POINTS, " 0 0 1") + face_rows).replace("\n", " ").encode()
    yield "off_faces", 2, ("STCOFF\n4 3 0\n" + rows(POINTS, " 1 2 3 4 0 1") +
                           face_rows.replace("\n", " 255 0 0\n")).encode()
    yield "ply_more", 1, (
        "ply\nformat ascii 1.0\ncomment c\nobj_info i\nelement vertex 4\n"
        "property float X\nproperty float Y\nproperty float Z\nproperty uchar alpha\n"
        "property list uchar uint views\nelement face 3\n"
        "property list uint uint vertex_index\nproperty list uchar float texcoord\n"
        "element edge 1\nproperty int vertex1\nend_header\n"
        + rows(POINTS, " 255 2 7 8") + face_rows.replace("\n", " 2 0 1\n") + "1\n"
    ).encode()
    yield "pcd_short", 0, (
        b"# of a car\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 4\nDATA ascii\n"
        + text + b"# end\n")
    yield "none", 9, text
    yield "none_obj", 9, (obj + obj_faces).encode()
    yield "obj", 4, (obj + obj_faces).encode()
    yield "obj_points", 4, obj.encode()
    yield "obj_full", 4, (
        "o name\n" + obj + "vt 0 1\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1 4/1/1\n"
        "f -1 -2 -3\nl 1 2\np 1 2 3\n").encode()
    yield "stl_ascii", 5, ("solid s\n" + stl_facets() + "endsolid s\n").encode()
    yield "stl_binary", 5, stl_binary
    yield "stl_tail", 5, b"solid" + stl_binary[5:] + b"tail"
    yield "stl_upper", 5, ("SOLID S\n\n" + stl_facets() + "ENDSOLID\n").upper().encode()


class Align:
    """Composes an input of fuzz_align: it takes these bytes in this order."""

    def __init__(self, seed):
        self.random = random.Random(seed)

    def settings(self):
        return self.random.randbytes(16)

    def cloud(self, size, axes=3, scale=b"\1", special=b"\0"):
        coordinates = self.random.randbytes(3 * size)
        used = b"".join(
            coordinates[i : i + axes] for i in range(0, len(coordinates), 3))
        return bytes([size]) + scale + b"\0" + bytes([axes - 1]) + used + special + b"\1"

    def similarity(self):
        return self.random.randbytes(3) + b"\1" + b"\5\1\6\1\7\1"


def align_inputs():
    for seed in range(24):
        make = Align(seed)
        size = 4 + 2 * seed % 44
        moved = b"\x0e" + make.settings() + make.cloud(size, 1 + (seed + 2) % 3)
        moved += b"\0" + make.similarity()
        yield "moved_%02d" % seed, moved
        yield "again_%02d" % seed, moved + b"\1" + make.settings() + b"\4" + make.cloud(9)
        guessed = b"\x86" + make.settings() + make.cloud(size) + make.cloud(20)
        yield "guess_%02d" % seed, guessed + b"\1" + make.similarity()
    for exponent in range(0, 76, 5):
        make = Align(exponent)
        scale = bytes([0, exponent])
        yield "size_%02d" % exponent, (
            b"\6" + make.settings() + make.cloud(30, scale=scale) + make.cloud(30))
    for value in range(27):
        make = Align(value)
        special = bytes([1, 1, 3, 0, 2 * value, 1])
        yield "special_%02d" % value, (
            b"\6" + make.settings() + make.cloud(20, special=special) + make.cloud(20))


def main():
    folder = pathlib.Path(sys.argv[1])
    readers, align = folder / "readers", folder / "align"
    for made in readers, align:
        made.mkdir(parents=True)
    for name, extension, content in reader_inputs():
        (readers / name).write_bytes(bytes([extension]) + content)
    for name, content in align_inputs():
        (align / name).write_bytes(content)


main()
