using FractalEngine.Core;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Wavefront.Writing;

/// <summary>
/// Writes one mesh as an OBJ file that reads back as an equal mesh: every number bit for bit, with its groups and material files.
/// </summary>
public static class ObjMeshWriter
{
    private static readonly MeshGroup NoGroup = new(0, 0, "", "", "", 0);

    /// <summary>Writes a mesh and the number of its faces.</summary>
    /// <param name="mesh">Mesh of any size.</param>
    /// <param name="stream">Receives UTF-8 text.</param>
    /// <param name="objectName">Name of the object for faces whose group has none; empty for none.</param>
    /// <exception cref="FractalEngineException">
    /// The format can't express the mesh: a number is not finite, a name has a line break, or an array would be lost because no face
    /// uses it. Nothing is written then.
    /// </exception>
    public static void Write(Mesh mesh, Stream stream, string objectName = "")
    {
        RequireNumbers(mesh);
        RequireNames(mesh, objectName);
        var text = new ObjTextWriter(stream);
        text.WriteText(MeshCountHeader.Format(mesh.FaceCount) + "\n");
        foreach (var library in mesh.MaterialLibraries)
        {
            text.WriteText($"mtllib {library}\n");
        }

        // A file without any declaration is not a mesh.
        var needsName = mesh.VertexCount == 0 && mesh.MaterialLibraries.IsEmpty;
        text.WriteText(objectName.Length > 0 || needsName ? $"o {objectName}\n" : "");
        text.WriteTextureCoordinates(mesh.TextureCoordinates.AsSpan());
        for (var vertex = 0; vertex < mesh.VertexCount; vertex++)
        {
            text.WriteVertex(mesh.Vertex(vertex), mesh, vertex);
        }

        for (var i = 0; i < mesh.Normals.Length; i += 3)
        {
            text.WriteNumbers("vn", mesh.Normals.AsSpan(i, 3));
        }

        WriteFaces(mesh, text, objectName);
        text.Flush();
    }

    private static void WriteFaces(Mesh mesh, ObjTextWriter text, string objectName)
    {
        if (mesh.Groups.IsEmpty)
        {
            text.WriteFaces(mesh, 0, mesh.FaceCount);
            return;
        }

        var current = NoGroup with { ObjectName = objectName };
        foreach (var group in mesh.Groups)
        {
            var next = group.ObjectName.Length > 0 ? group : group with { ObjectName = objectName };
            WriteGroupChange(current, next, text);
            text.WriteFaces(mesh, group.FirstFace, group.FaceCount);
            current = next;
        }
    }

    private static void WriteGroupChange(MeshGroup current, MeshGroup next, ObjTextWriter text)
    {
        text.WriteText(next.ObjectName == current.ObjectName ? "" : $"o {next.ObjectName}\n");
        text.WriteText(next.GroupName == current.GroupName ? "" : $"g {next.GroupName}\n");
        text.WriteText(next.Material == current.Material ? "" : $"usemtl {next.Material}\n");
        text.WriteText(next.SmoothingGroup == current.SmoothingGroup ? "" : FormattableString.Invariant($"s {next.SmoothingGroup}\n"));
    }

    private static void RequireNumbers(Mesh mesh)
    {
        Require(mesh.TextureCoordinates.All(double.IsFinite), "a texture coordinate is not finite");
        Require(mesh.Colours.All(double.IsFinite), "a component of a colour is not finite");
        Require(mesh.Normals.All(double.IsFinite), "a component of a normal is not finite");
        Require(IsUsed(mesh.TextureCoordinates.Length, mesh.TextureIndices), "no face uses the texture coordinates");
        Require(IsUsed(mesh.Normals.Length, mesh.NormalIndices), "no face uses the normals");
    }

    private static bool IsUsed(int elementCount, IReadOnlyList<int> indices) =>
        indices.Count == 0 ? elementCount == 0 : indices.Any(index => index != PolygonCorner.None);

    private static void RequireNames(Mesh mesh, string objectName)
    {
        RequireName(objectName);
        var firstFace = 0;
        var previous = NoGroup;
        foreach (var group in mesh.Groups)
        {
            RequireName(group.ObjectName);
            RequireName(group.GroupName);
            RequireName(group.Material);
            Require(group.SmoothingGroup >= 0, "the number of a smoothing group is negative");
            Require(group.FirstFace == firstFace && group.FaceCount > 0, "its groups are empty, or not in the order of the faces");
            Require(firstFace == 0 || group with { FirstFace = 0, FaceCount = 0 } != previous, "two neighbouring groups have equal names");
            previous = group with { FirstFace = 0, FaceCount = 0 };
            firstFace += group.FaceCount;
        }

        Require(mesh.Groups.IsEmpty || firstFace == mesh.FaceCount, "its groups don't cover all faces");
        foreach (var library in mesh.MaterialLibraries)
        {
            RequireName(library);
            Require(library.Length > 0, "the name of a material file is empty");
        }

        Require(mesh.MaterialLibraries.Distinct().Count() == mesh.MaterialLibraries.Length, "a material file is named twice");
    }

    private static void RequireName(string name)
    {
        const string faults = "a line break, a comment, a faulty character, blanks at an end, or a backslash at its end";
        Require(WritableNames.IsRestOfLine(name), $"the name '{WritableNames.Escape(name)}' has {faults}");
    }

    private static void Require(bool condition, string fault)
    {
        if (!condition)
        {
            throw new FractalEngineException($"the mesh can't be written as an OBJ file: {fault}");
        }
    }
}
