using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using BigInteger = System.Numerics.BigInteger;

namespace FractalEngine.Core.Scenes;

/// <summary>Area and volume of all that a scene shows, and whether its meshes are closed. What overlaps counts each time.</summary>
/// <param name="Area">
/// Scene units²; null where it is not known: of what is infinite or componentwise, and of more than five million faces of fractals that
/// have maps other than similarities, or more than 20,000 maps.
/// </param>
/// <param name="Volume">Scene units³; null where a mesh is open, and of what is infinite, componentwise, or of so many maps.</param>
/// <param name="Open">The first mesh that is not closed and the middle of an open edge of it, in its own frame; null where all are.</param>
public readonly record struct SurfaceSummary(double? Area, double? Volume, (string Mesh, Vector Edge)? Open)
{
    // Levels take some hundred bytes a map.
    private const long MaxMaps = 20_000;

    // About a second, and 400 MB for a while.
    private const long MaxExpandedFaces = 5_000_000;

    /// <summary>Measures a scene, of fractals level by level.</summary>
    /// <remarks>Cost O(faces of all meshes): about a second for a million.</remarks>
    public static SurfaceSummary Of(LoadedScene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var open = FindOpen(scene);
        var (area, volume) = (0.0, (double?)0);
        // Many objects may share a model.
        var known = new Dictionary<Model, (double? Area, double? Volume)>(ReferenceEqualityComparer.Instance);
        var others = new List<PlacedModel>();
        foreach (var placed in scene.Objects)
        {
            if (!known.TryGetValue(placed.Model, out var own))
            {
                known.Add(placed.Model, own = (MeasureArea(placed.Model), open is null ? MeasureVolume(placed.Model) : null));
            }

            var linear = placed.ObjectToWorld.Linear;
            volume += own.Volume * Math.Abs(linear.Determinant());
            if (own.Area is { } ownArea && linear.IsSimilarity())
            {
                area += ownArea * linear.V1.LengthSquared();
            }
            else
            {
                others.Add(placed);
            }
        }

        return new(area + ExpandedArea(others), volume, open);
    }

    /// <summary>Finds an open edge of the first mesh that has one.</summary>
    private static (string Mesh, Vector Edge)? FindOpen(LoadedScene scene)
    {
        foreach (var model in scene.Models)
        {
            foreach (var (index, mesh) in (model is FractalModel { Fractal: var fractal } ? fractal.BaseMeshes : [model.Mesh]).Index())
            {
                if (SurfaceEdges.Of(mesh).FirstOpen is { } edge)
                {
                    return (model.MeshNameAt(index), edge);
                }
            }
        }

        return null;
    }

    /// <summary>Measures objects whose area does not follow from that of their base meshes, all or none.</summary>
    private static double? ExpandedArea(List<PlacedModel> objects)
    {
        var faces = BigInteger.Zero;
        foreach (var placed in objects)
        {
            var isComponentwise = placed.Model is FractalModel { Fractal.Description.Composition: Composition.Componentwise };
            faces += (isComponentwise ? null : placed.Model.FaceCount) ?? MaxExpandedFaces + 1;
        }

        return faces > MaxExpandedFaces
            ? null
            : objects.Sum(static placed => new[] { placed }.Flatten(MaxExpandedFaces).SurfaceArea());
    }

    private static double? MeasureArea(Model model) => model is not FractalModel { Fractal: var fractal }
        ? model.Mesh.SurfaceArea()
        : HierarchyOf(fractal) is { HasOnlySimilarities: true } hierarchy
            ? LevelSums.Of(
                hierarchy, index => hierarchy.BaseMeshes[index].SurfaceArea(), static (area, child) => area * child.ScaleSquared)
            : null;

    private static double? MeasureVolume(Model model) => model is not FractalModel { Fractal: var fractal }
        ? VolumeOf(model.Mesh)
        : HierarchyOf(fractal) is { } hierarchy
            ? LevelSums.Of(
                hierarchy, index => VolumeOf(hierarchy.BaseMeshes[index]),
                static (volume, child) => volume * Math.Abs(child.Map.Linear.Determinant()))
            : null;

    /// <summary>The levels of a fractal, where they don't take much more memory than its file.</summary>
    private static FractalHierarchy? HierarchyOf(Fractal fractal) =>
        fractal.Description.MapCount <= MaxMaps ? fractal.FindHierarchy() : null;

    /// <summary>The volume within a closed mesh, also one that is wound inwards: of tetrahedra over its faces, with their signs.</summary>
    private static double VolumeOf(Mesh mesh)
    {
        var (centre, sum) = (mesh.UsedBounds.Centre, 0.0);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            sum += Vector.Dot(a - centre, Vector.Cross(b - centre, c - centre));
        }

        return Math.Abs(sum) / 6;
    }
}
