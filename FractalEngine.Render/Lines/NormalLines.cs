using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Lines;

/// <summary>Normals of faces as lines from the middles of the faces.</summary>
public static class NormalLines
{
    /// <summary>Maximum number of normals; those of further faces are left out.</summary>
    public const int MaxNormals = 5000;

    // Length of a normal by the length of the longest edge of its face.
    private const double LengthRatio = 0.4;

    private static readonly Colour LineColour = new(0.3, 0.9, 1);

    /// <summary>Lists the normals of all objects that are meshes, world space.</summary>
    /// <param name="scene">The scene with its bodies where they are.</param>
    public static IReadOnlyList<LineSegment> OfMeshes(LoadedScene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var lines = new List<LineSegment>();
        foreach (var placed in scene.Objects.Where(static placed => placed.Model is MeshModel))
        {
            AddMesh(lines, placed.Model.Mesh, placed.ObjectToWorld);
        }

        return lines;
    }

    /// <summary>Lists the normals of a mesh.</summary>
    /// <param name="mesh">The mesh in its own frame.</param>
    /// <param name="map">From that frame to that of the lines.</param>
    public static IReadOnlyList<LineSegment> Of(Mesh mesh, in AffineMap map)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        var lines = new List<LineSegment>();
        AddMesh(lines, mesh, map);
        return lines;
    }

    private static void AddMesh(List<LineSegment> lines, Mesh mesh, in AffineMap map)
    {
        for (var face = 0; face < mesh.FaceCount && lines.Count < MaxNormals; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var (first, second) = (map.Linear * (b - a), map.Linear * (c - a));
            var normal = Vector.Cross(first, second);
            var length = normal.Length();
            if (length > 0 && double.IsFinite(length))
            {
                var middle = (1.0 / 3) * ((map * a) + (map * b) + (map * c));
                var edge = Math.Max(first.Length(), second.Length());
                lines.Add(new(middle, middle + (LengthRatio * edge / length * normal), LineColour));
            }
        }
    }
}
