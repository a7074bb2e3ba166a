using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using SharpGLTF.Schema2;
using SharpGLTF.Transforms;
using Mesh = SharpGLTF.Schema2.Mesh;

namespace FractalEngine.Parsing.Gltf;

/// <summary>The nodes of a glTF file with their places, and which of their meshes are worth being kept once.</summary>
internal static class GltfNodes
{
    // Each mesh is drawn by itself, by a search through the places of all.
    private const long MaxVisits = 2_000_000;

    // Those of a fractal that can be searched, less one for each mesh.
    private static readonly long MaxPlaces = FractalLimits.HierarchyChildren.Value - ParsingLimits.BaseFiles.Value;

    /// <summary>Lists the nodes of the default scene, or all where there is none: parents before their children.</summary>
    /// <exception cref="InvalidDataException">A node has two parents.</exception>
    public static List<(Node Node, AffineMap ToWorld)> List(ModelRoot root)
    {
        IEnumerable<Node> roots = root.DefaultScene is { } scene ? scene.VisualChildren
            : root.LogicalNodes.Where(static node => node.VisualParent is null);
        var open = new Stack<(Node Node, AffineMap ToParent)>(roots.Reverse().Select(static node => (node, AffineMap.Identity)));
        var (closed, result) = (new HashSet<int>(), new List<(Node, AffineMap)>());
        while (open.TryPop(out var item))
        {
            if (!closed.Add(item.Node.LogicalIndex))
            {
                throw new InvalidDataException($"the node '{item.Node.Name}' has two parents");
            }

            var toWorld = item.ToParent * ToMap(new(item.Node.LocalMatrix));
            result.Add((item.Node, toWorld));
            foreach (var child in item.Node.VisualChildren.Reverse())
            {
                open.Push((child, toWorld));
            }
        }

        return result;
    }

    /// <summary>Returns the places of the mesh of a node, with colours that instances have: one, or those of its instances.</summary>
    public static IEnumerable<(AffineMap Map, MapColour Colour)> PlacesOf(Node node, AffineMap toWorld)
    {
        if (node.GetExtension<MeshGpuInstancing>() is not { } instancing)
        {
            return [(toWorld, default)];
        }

        var colours = instancing.Accessors.GetValueOrDefault("_COLOR_0")?.AsColorArray(1);
        return Enumerable.Range(0, instancing.Count).Select(index => (
            toWorld * ToMap(new(instancing.GetLocalMatrix(index))),
            colours is null ? default : new MapColour(new Colour(colours[index].X, colours[index].Y, colours[index].Z).FromLinear(), 1)));
    }

    /// <summary>Tells whether a place can be a map of a fractal: it flattens nothing, and stays within the numbers of files.</summary>
    public static bool HasInverse(AffineMap place) =>
        place.IsFinite() && Math.Abs(place.Linear.Determinant()) is > 0 and < double.PositiveInfinity;

    /// <summary>The number of corners that a place of a mesh takes.</summary>
    public static long CornerCount(Mesh mesh) => mesh.Primitives
        .Where(static primitive => primitive.DrawPrimitiveType >= PrimitiveType.TRIANGLES)
        .Sum(static primitive => (long)Math.Max(primitive.GetVertexAccessor("POSITION")?.Count ?? 0, primitive.IndexAccessor?.Count ?? 0));

    /// <summary>
    /// Chooses the meshes that stand at several places, those first that would take the most memory; no more of them, and of their places,
    /// than a fractal can be drawn with.
    /// </summary>
    public static IEnumerable<Mesh> ChooseInstanced(List<(Node Node, AffineMap ToWorld)> nodes)
    {
        var counted = nodes.Where(static one => one.Node.Mesh is not null).GroupBy(static one => one.Node.Mesh)
            .Select(static uses => (Mesh: uses.Key, Count: uses.Sum(
                static one => one.Node.GetExtension<MeshGpuInstancing>() is { Count: var count } ? (long)count : 1)))
            .Where(static one => one.Count > 1 && CornerCount(one.Mesh) > 0)
            .OrderByDescending(static one => (one.Count - 1) * CornerCount(one.Mesh)).Take((int)ParsingLimits.BaseFiles.Value - 1);
        var (meshes, places) = (0, 0L);
        foreach (var (mesh, count) in counted.Where(
            one => places + one.Count <= Math.Min(MaxPlaces, MaxVisits / (meshes + 1))))
        {
            meshes++;
            places += count;
            yield return mesh;
        }
    }

    /// <summary>The map of a matrix whose rows are the images of the axes and of the origin.</summary>
    private static AffineMap ToMap(Matrix4x4Double matrix) => new(
        new(new(matrix.M11, matrix.M12, matrix.M13), new(matrix.M21, matrix.M22, matrix.M23), new(matrix.M31, matrix.M32, matrix.M33)),
        new(matrix.M41, matrix.M42, matrix.M43));
}
