using System.Collections.Immutable;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Preparation;

/// <summary>Prepares single models for the GPU, and creates the boxes that are shown until then.</summary>
internal static class ModelPreparation
{
    // With fewer instances, culling back faces saves less than the test for a solid costs.
    private const int MinInstancesForSolidTest = 100;
    private const int MaxFacesForSolidTest = 256;

    // Tested on the thread that draws, once: about 0.2 s.
    private const int MaxFacesForSections = 300_000;

    /// <summary>Prepares a model for the GPU.</summary>
    /// <param name="model">Model with its mesh and materials.</param>
    /// <param name="settings">Settings with the budgets and the crease angle.</param>
    /// <param name="textures">Cache that decodes the textures.</param>
    /// <param name="notices">Receives sentences for the user about whatever is not drawn in full.</param>
    public static DrawableModel Prepare(
        Model model, RenderSettings settings, TextureCache textures, ImmutableArray<string>.Builder notices)
    {
        var name = model.Name;
        var mesh = model.Mesh;
        if (mesh.FaceCount == 0)
        {
            return CreateEmpty(name, isPlaceholder: false);
        }

        var hierarchy = settings.Culling is null ? null : TryBuildHierarchy(name, model, notices);
        var (maps, tints) = hierarchy is null && model is FractalModel { Fractal: var fractal }
            ? Expand(name, fractal, settings, notices)
            : ([AffineMap.Identity], []);
        // Of faces alone: floats relative to a vertex far away that none has would lose their shape.
        var meshOrigin = CentreOrOrigin(mesh.UsedBounds);
        var origin = model is MeshModel ? meshOrigin : CentreOrOrigin(model.Bounds);
        var batches = FaceBatches.ByMaterial(model, textures, settings.RemoveDegenerateTriangles);
        var (vertices, textureCoordinates, colours, indices) = DrawableMeshBuilder.Build(mesh, meshOrigin, settings.CreaseAngle, batches);
        var testsSolidity = hierarchy is not null
            ? model is FractalModel || mesh.FaceCount <= MaxFacesForSolidTest
            : maps.Length >= MinInstancesForSolidTest;
        // The inner sides of a solid are visible through transparent faces and holes.
        var isSeeThrough = !batches.Batches.All(static batch => batch.IsSolid);
        var meshWindingSign = testsSolidity && !isSeeThrough && ClosedSurface.IsSolid(mesh) ? 1 : 0;
        var instanceSign = hierarchy is null ? CommonOrientation(name, maps) : OrientationOfInstances(model);
        // The instances of a fractal with a hierarchy are selected for each frame.
        var instances = hierarchy is null || model is MeshModel ? ToInstanceRows(maps, meshOrigin, origin) : [];
        return new(name, origin, model.Bounds, vertices, indices, instances)
        {
            LodHierarchy = hierarchy,
            MeshOrigin = meshOrigin,
            TextureCoordinates = textureCoordinates,
            Colours = colours,
            InstanceTints = MemoryMarshal.Cast<Vector128<float>, float>(tints.Select(static tint => tint.ToSingle()).ToArray()).ToArray(),
            Batches = batches.Batches,
            DegenerateTriangleCount = batches.DegenerateTriangleCount,
            HasCoveredSides = hierarchy?.HasCoveredSides == true && HasNormalsOfFaces(vertices, indices),
            HasOpenSky = model is FractalModel && hierarchy?.HasOpenSky() == true,
            IsFlat = hierarchy?.IsFlat() == true,
            IsConvex = model is MeshModel && meshWindingSign > 0 && UnshadedSurface.IsConvex(mesh),
            MeshWindingSign = meshWindingSign,
            WindingSign = meshWindingSign * instanceSign,
            SolidSign = testsSolidity || isSeeThrough || mesh.FaceCount > MaxFacesForSections
                ? new(meshWindingSign * instanceSign)
                : new(() => ClosedSurface.IsSolid(mesh) ? instanceSign : 0),
        };
    }

    /// <summary>Creates the box that is shown until a model is prepared. A model without finite bounds has none.</summary>
    public static DrawableModel CreatePlaceholder(Model model)
    {
        var name = model.Name;
        var bounds = model.Bounds;
        if (model.Mesh.FaceCount == 0 || bounds.IsEmpty || !bounds.Size.IsFinite())
        {
            return CreateEmpty(name, isPlaceholder: true);
        }

        var mesh = Shapes.Box(bounds);
        var batches = FaceBatches.SingleBatch(mesh);
        var (vertices, _, _, indices) = DrawableMeshBuilder.Build(mesh, bounds.Centre, 0, batches);
        var instances = ToInstanceRows([AffineMap.Identity], bounds.Centre, bounds.Centre);
        return new(name, bounds.Centre, bounds, vertices, indices, instances) { Batches = batches.Batches, IsPlaceholder = true };
    }

    private static DrawableModel CreateEmpty(string name, bool isPlaceholder) =>
        new(name, Vector.Zero, BoundingBox.Empty, [], [], []) { IsPlaceholder = isPlaceholder };

    /// <summary>Builds the hierarchy that instances are selected from; null where the fractal has no bounds and must be expanded.</summary>
    public static LodHierarchy? TryBuildHierarchy(string name, Model model, ImmutableArray<string>.Builder notices)
    {
        try
        {
            return model is FractalModel { Fractal: var fractal } ? LodHierarchy.Build(fractal) : LodHierarchy.Build(model.Mesh);
        }
        catch (Exception exception) when (exception is FractalLimitException or SingularMatrixException)
        {
            notices.Add($"{name}: {exception.Message}");
            return null;
        }
    }

    private static (ImmutableArray<AffineMap> Maps, ImmutableArray<Tint> Tints) Expand(
        string name, Fractal fractal, RenderSettings settings, ImmutableArray<string>.Builder notices)
    {
        // A fractal without a hierarchy is drawn with no more instances than culling would leave.
        var budget = Math.Min(settings.InstanceBudget, settings.Culling?.InstanceBudget ?? int.MaxValue);
        var (maps, tints, notice) = FractalInstances.Expand(name, fractal, settings with { InstanceBudget = budget });
        if (notice is not null)
        {
            notices.Add(notice);
        }

        return (maps, tints);
    }

    /// <summary>Returns 1 where all instances of a model certainly keep the orientation of its mesh, otherwise 0.</summary>
    private static int OrientationOfInstances(Model model) =>
        model is FractalModel { Fractal.PreservesOrientation: false } ? 0 : 1;

    /// <summary>Returns the sign that the determinants of all maps have; 0 where they differ or one is singular.</summary>
    /// <exception cref="FractalLimitException">A map is beyond the range of a double.</exception>
    private static int CommonOrientation(string name, ImmutableArray<AffineMap> maps)
    {
        int? commonSign = null;
        foreach (ref readonly var map in maps.AsSpan())
        {
            var determinant = map.Linear.Determinant();
            if (double.IsNaN(determinant) || !map.IsFinite())
            {
                throw new FractalLimitException($"{name}: an instance is beyond the range of a double, so that nothing can be drawn");
            }

            var sign = Math.Sign(determinant);
            if (sign != (commonSign ??= sign))
            {
                commonSign = 0;
            }
        }

        return commonSign ?? 1;
    }

    /// <summary>Whether all vertices have the normals of their triangles, which lie along axes.</summary>
    private static bool HasNormalsOfFaces(float[] vertices, uint[] indices)
    {
        return indices.Chunk(3).All(face =>
        {
            var normal = Vector.Cross(At(face[1], 0) - At(face[0], 0), At(face[2], 0) - At(face[0], 0));
            return Array.TrueForAll(
                face, vertex => Vector.Cross(normal, At(vertex, 3)) == Vector.Zero && Vector.Dot(normal, At(vertex, 3)) > 0);
        });

        Vector At(uint vertex, int offset)
        {
            var start = (DrawableModel.FloatsPerVertex * (int)vertex) + offset;
            return new(vertices[start], vertices[start + 1], vertices[start + 2]);
        }
    }

    /// <summary>Returns the centre of a box, or the origin where it is infinite, as that of an unbounded fractal.</summary>
    private static Vector CentreOrOrigin(BoundingBox box) => box.Centre.IsFinite() ? box.Centre : Vector.Zero;

    /// <summary>
    /// Returns the maps between the translated frames as instances. They are translated in double precision, before rounding to single.
    /// </summary>
    private static float[] ToInstanceRows(ImmutableArray<AffineMap> maps, Vector meshOrigin, Vector origin)
    {
        var rows = new float[maps.Length * DrawableModel.FloatsPerInstance];
        var remaining = rows.AsSpan();
        foreach (ref readonly var map in maps.AsSpan())
        {
            InstanceRow.Write(map.Linear, (map * meshOrigin) - origin, remaining);
            remaining = remaining[DrawableModel.FloatsPerInstance..];
        }

        return rows;
    }
}
