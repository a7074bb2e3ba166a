using System.Globalization;
using System.IO.Compression;
using System.Xml.Linq;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Exports;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Ply;
using FractalEngine.Parsing.Stl;

namespace FractalEngine.Tests.Parsing.Exports;

/// <summary>Writes scenes in a format, and reads the files back.</summary>
internal static class ExportedFile
{
    private static readonly XNamespace Core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";

    public static byte[] Write(SceneExport format, LoadedScene scene, ExportSettings? settings = null)
    {
        using var stream = new MemoryStream();
        format.Write(scene, settings ?? new(), stream);
        return stream.ToArray();
    }

    /// <summary>Reads a PLY or STL file by the readers of models.</summary>
    public static Mesh Read(string ending, byte[] bytes) => ending == ".ply"
        ? PlyReader.Read(new MeshBytes("x.ply", bytes)).Mesh : StlReader.Read(new MeshBytes("x.stl", bytes)).Mesh;

    /// <summary>Reads the triangles of all that a 3MF file builds, by its specification: components inside each other.</summary>
    public static List<(Vector A, Vector B, Vector C, string? Colour)> ReadThreeMf(byte[] bytes)
    {
        var model = ReadModel(bytes);
        var objects = model.Descendants(Core + "object").ToDictionary(one => one.Attribute("id")!.Value);
        var colours = model.Descendants(Core + "base").Select(one => one.Attribute("displaycolor")!.Value).ToArray();
        return [.. model.Descendants(Core + "item").SelectMany(item => Expand(item).Select(face => (
            MapOf(item) * face.A, MapOf(item) * face.B, MapOf(item) * face.C, face.Colour)))];

        IEnumerable<(Vector A, Vector B, Vector C, string? Colour)> Expand(XElement place)
        {
            var one = objects[place.Attribute("objectid")!.Value];
            foreach (var component in one.Descendants(Core + "component"))
            {
                var map = MapOf(component);
                // The specification forbids mirrors (§4.2).
                Assert.True(map.Linear.Determinant() > 0);
                foreach (var (a, b, c, colour) in Expand(component))
                {
                    yield return (map * a, map * b, map * c, colour);
                }
            }

            Vector[] vertices = [.. one.Descendants(Core + "vertex").Select(vertex => new Vector(
                Number(vertex, "x"), Number(vertex, "y"), Number(vertex, "z")))];
            foreach (var face in one.Descendants(Core + "triangle"))
            {
                var colour = face.Attribute("p1") ?? one.Attribute("pindex");
                yield return (
                    vertices[(int)Number(face, "v1")], vertices[(int)Number(face, "v2")], vertices[(int)Number(face, "v3")],
                    colour is null ? null : colours[int.Parse(colour.Value, CultureInfo.InvariantCulture)]);
            }
        }
    }

    public static XElement ReadModel(byte[] bytes)
    {
        using var archive = new ZipArchive(new MemoryStream(bytes));
        Assert.Equal(["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"], archive.Entries.Select(entry => entry.FullName));
        Assert.All(archive.Entries, entry => XDocument.Load(entry.Open()));
        return XDocument.Load(archive.GetEntry("3D/3dmodel.model")!.Open()).Root!;
    }

    public static double Volume(IEnumerable<(Vector A, Vector B, Vector C)> faces) =>
        faces.Sum(static face => Vector.Dot(face.A, Vector.Cross(face.B, face.C)) / 6);

    private static AffineMap MapOf(XElement place)
    {
        if (place.Attribute("transform") is not { } transform)
        {
            return AffineMap.Identity;
        }

        var m = transform.Value.Split(' ').Select(text => double.Parse(text, CultureInfo.InvariantCulture)).ToArray();
        Assert.Equal(12, m.Length);
        // Rows of the file are images of the axes.
        return new(new(new(m[0], m[1], m[2]), new(m[3], m[4], m[5]), new(m[6], m[7], m[8])), new(m[9], m[10], m[11]));
    }

    private static double Number(XElement element, string name) =>
        double.Parse(element.Attribute(name)!.Value, CultureInfo.InvariantCulture);
}
