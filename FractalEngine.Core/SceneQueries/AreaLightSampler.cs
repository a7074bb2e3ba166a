using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels.Lights;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.SceneQueries;

/// <summary>
/// Chooses points of a scene's emissive faces, those that matter to a surface more often. A hierarchy over the objects, the levels of
/// fractals and the faces of meshes is walked down, so that 10²⁰ lamps cost kilobytes. Immutable: any number of threads may choose.
/// </summary>
/// <remarks>
/// Exact in probability: the density of a choice can be found again from a ray's hit. Fractals that are infinite, composed componentwise or
/// of thousands of levels are never chosen: their density is 0.
/// </remarks>
public sealed class AreaLightSampler
{
    private readonly Dictionary<int, (AreaLightNode Node, int Slot)> _places = [];
    private readonly AreaLightNode? _root;
    private readonly AreaLightModel?[] _models;
    private readonly AffineMap[] _maps;
    private readonly double[] _norms;
    private readonly bool _isUniform;

    /// <summary>Prepares the emissive faces of a scene.</summary>
    /// <param name="scene">With its models loaded.</param>
    /// <param name="radianceOf">
    /// How brightly a face of one of <see cref="Model.Parts"/> shines, by its index in the mesh of the part; 0 for most.
    /// </param>
    /// <param name="isUniform">True to choose each face with the same probability, to compare.</param>
    /// <exception cref="FractalLimitException">The bounds of some level of a fractal overflow a double, or don't converge.</exception>
    /// <remarks>Cost: O(n log n) for n objects and emissive faces of meshes, and the levels of the fractals.</remarks>
    public AreaLightSampler(LoadedScene scene, Func<Model, int, double> radianceOf, bool isUniform = false)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ArgumentNullException.ThrowIfNull(radianceOf);
        _isUniform = isUniform;
        var known = scene.Models.ToDictionary(static model => model, model => CreateOrNull(model, radianceOf));
        _models = [.. scene.Objects.Select(placed => known[placed.Model])];
        _maps = [.. scene.Objects.Select(static placed => placed.ObjectToWorld)];
        _norms = [.. scene.Objects.Select(static placed => BoundingSphere.OperatorNormBound(placed.ObjectToWorld.Linear))];
        _root = AreaLightNode.Build(
            [.. _models.Select((model, index) =>
                model?.Root?.Total.Transform(_maps[index], _norms[index], isUniform) ?? default)],
            _places);
        StorageBytes = (_root?.StorageBytes ?? 0) + known.Values.Sum(static model => model?.StorageBytes ?? 0) + (116L * _maps.Length);
    }

    /// <summary>True where nothing shines that can be chosen.</summary>
    public bool IsEmpty => _root is null;

    /// <summary>Area times radiance of all faces, scene units: exact for similarities.</summary>
    public double Power => _root?.Total.Power ?? 0;

    /// <summary>Bytes that the hierarchy of lamps takes: objects, levels and faces.</summary>
    public long StorageBytes { get; }

    /// <summary>Chooses a point of an emissive face.</summary>
    /// <param name="position">Point of the surface, world space.</param>
    /// <param name="normal">Its unit normal.</param>
    /// <param name="number">From 0 to below 1: chooses the face.</param>
    /// <param name="point">A point of the unit square: chooses the point of the face.</param>
    /// <param name="context">Receives the choice.</param>
    /// <param name="sample">The point.</param>
    /// <returns>False where the choice fell on a place without faces.</returns>
    public bool TrySample(
        Vector position, Vector normal, double number, (double U, double V) point, QueryContext context, out AreaLightSample sample)
    {
        ArgumentNullException.ThrowIfNull(context);
        sample = default;
        if (_root is null)
        {
            return false;
        }

        var walk = new AreaLightWalk(position, normal, number, _isUniform);
        var index = AreaLightModel.ChooseItem(ref walk, _root);
        var face = -1;
        if (!TryWalk(ref walk, index, context.LightPath, [], ref face, out var triangle))
        {
            return false;
        }

        var root = Math.Sqrt(point.U);
        var (a, b, c) = triangle;
        sample = new(index, face, ((1 - root) * a) + (root * (1 - point.V) * b) + (root * point.V * c));
        return true;
    }

    /// <summary>Tells whether a ray has hit the face that was chosen last.</summary>
    /// <param name="sample">The choice.</param>
    /// <param name="context">That of the choice, and of the ray after it.</param>
    /// <param name="faceIndex">Index of the face that was hit.</param>
    public static bool IsFound(in AreaLightSample sample, QueryContext context, int faceIndex)
    {
        ArgumentNullException.ThrowIfNull(context);
        return sample.FaceIndex == faceIndex && sample.ObjectIndex == context.ObjectIndex
            && context.ChildPath.SequenceEqual(System.Runtime.InteropServices.CollectionsMarshal.AsSpan(context.LightPath));
    }

    /// <summary>Computes how likely <see cref="TrySample"/> chooses a point, per area.</summary>
    /// <param name="position">Point of the surface, world space.</param>
    /// <param name="normal">Its unit normal.</param>
    /// <param name="context">That of the ray that has hit the point.</param>
    /// <param name="faceIndex">Index of the face that was hit.</param>
    /// <returns>0 for faces that are never chosen, and for proxies of what is smaller than the width of the ray.</returns>
    public double DensityOf(Vector position, Vector normal, QueryContext context, int faceIndex)
    {
        ArgumentNullException.ThrowIfNull(context);
        if (context.ChildPathLength < 0 || !_places.TryGetValue(context.ObjectIndex, out var place))
        {
            return 0;
        }

        var walk = new AreaLightWalk(position, normal, 0, _isUniform);
        AreaLightModel.FollowItem(ref walk, place);
        return TryWalk(ref walk, context.ObjectIndex, null, context.ChildPath, ref faceIndex, out var triangle)
            ? walk.Probability / (0.5 * Vector.Cross(triangle.B - triangle.A, triangle.C - triangle.A).Length())
            : 0;
    }

    private bool TryWalk(
        ref AreaLightWalk walk, int index, List<int>? chosen, ReadOnlySpan<int> known, ref int face,
        out (Vector A, Vector B, Vector C) triangle)
    {
        walk.Enter(in _maps[index], _norms[index], _models[index]!.Root);
        return _models[index]!.TryWalk(ref walk, chosen, known, ref face, out triangle);
    }

    private AreaLightModel? CreateOrNull(Model model, Func<Model, int, double> radianceOf)
    {
        var parts = model.Parts;
        // Before levels are built that nobody needs.
        if (!parts.Any(part => Enumerable.Range(0, part.Mesh.FaceCount).Any(face => radianceOf(part, face) > 0)))
        {
            return null;
        }

        return model switch
        {
            FractalModel { Fractal: { Description: { Composition: Composition.Affine, IsInfinite: false } } fractal } lamp => new(
                lamp.Named(static fractal => fractal.Hierarchy), fractal.Hierarchy.BaseMeshes,
                (mesh, face) => radianceOf(parts.Length == 1 ? parts[0] : parts[mesh], face), _isUniform),
            FractalModel => null,
            _ => new(null, [model.Mesh], (_, face) => radianceOf(model, face), _isUniform),
        };
    }
}
