using System.Collections.Immutable;
using FractalEngine.Core.Detail;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Preparation;

/// <summary>
/// A scene prepared for the GPU: vertices, indices and instances as plain arrays. Made without any GL, so that it can be made on another
/// thread while a window stays responsive.
/// </summary>
public sealed class DrawableScene
{
    // With fewer copies, leaving out what is not seen saves less than finding out that it is not.
    private const int CheckedInstances = 100;
    private const int CheckedFaces = 256;

    private DrawableScene(
        LoadedScene source, ImmutableArray<DrawableModel> models, ImmutableArray<DrawableObject> objects, ImmutableArray<string> notices) =>
        (Source, Models, Objects, Notices) = (source, models, objects, notices);

    /// <summary>What it was made from.</summary>
    public LoadedScene Source { get; }

    /// <summary>Each model once, in the order of first use.</summary>
    public ImmutableArray<DrawableModel> Models { get; }

    /// <summary>In the order of the scene's objects.</summary>
    public ImmutableArray<DrawableObject> Objects { get; }

    /// <summary>The pictures of all materials, each once.</summary>
    public ImmutableArray<DrawableTexture> Textures { get; private init; } = [];

    /// <summary>Sentences for the user about what is not drawn in full.</summary>
    public ImmutableArray<string> Notices { get; }

    /// <summary>The instances that one frame draws.</summary>
    public long InstanceCount => Objects.Sum(item => (long)item.Model.InstanceCount);

    /// <summary>The triangles that one frame draws.</summary>
    public long TriangleCount => Objects.Sum(item => item.Model.TriangleCount);

    /// <summary>Prepares a scene.</summary>
    /// <param name="scene">With its files loaded.</param>
    /// <param name="settings">Budgets and crease angle.</param>
    /// <param name="progress">Told of each model before and after it is prepared, on this thread.</param>
    /// <param name="cancellation">Looked at between models.</param>
    /// <exception cref="OperationCanceledException">Preparation was cancelled.</exception>
    /// <remarks>Time and memory grow with the instances drawn: about 0.2 s and 150 MB a million.</remarks>
    public static DrawableScene Prepare(
        LoadedScene scene,
        RenderSettings settings,
        IProgress<PreparationProgress>? progress = null,
        CancellationToken cancellation = default)
    {
        var preparation = new ScenePreparation(scene, settings);
        preparation.PrepareAll(progress, cancellation);
        return preparation.Scene;
    }

    /// <summary>A scene whose models are boxes.</summary>
    internal static DrawableScene Outline(LoadedScene scene)
    {
        var models = scene.Models.ToDictionary(model => model, Placeholder, ReferenceEqualityComparer.Instance as IEqualityComparer<Model>);
        return new(
            scene,
            [.. scene.Models.Select(model => models[model])],
            [.. scene.Objects.Select((placed, index) => new DrawableObject(
                placed.Declaration.Name ?? models[placed.Model].Name,
                models[placed.Model],
                placed.Map,
                placed.Declaration.Colour ?? ObjectPalette.ColourOf(index))
            {
                Tint = placed.Declaration.Colour ?? Colour.White,
                Gradient = placed.Declaration.Gradient,
                IsMoving = placed is { Declaration: PhysicsObject, Model: MeshModel },
            })],
            []);
    }

    /// <summary>The scene with one of its models in the place of another.</summary>
    internal DrawableScene With(DrawableModel before, DrawableModel now, ImmutableArray<DrawableTexture> textures, ImmutableArray<string> notices) => new(
        Source,
        [.. Models.Select(model => model == before ? now : model)],
        [.. Objects.Select(item => item.Model == before ? item with { Model = now } : item)],
        notices)
    {
        Textures = textures,
    };

    /// <summary>Prepares one model.</summary>
    internal static DrawableModel PrepareModel(
        Model model, RenderSettings settings, TextureCache textures, ImmutableArray<string>.Builder notices)
    {
        var (name, mesh) = (Path.GetFileName(model.Path), model.Mesh);
        if (mesh.FaceCount == 0)
        {
            return new(name, Vector.Zero, BoundingBox.Empty, [], [], []);
        }

        var detail = settings.Detail is null ? null : TableOf(name, model, notices);
        var maps = ImmutableArray.Create(AffineMap.Identity);
        if (detail is null && model is FractalModel { Fractal: var fractal })
        {
            (maps, var notice) = FractalInstances.Of(name, fractal, settings);
            if (notice is not null)
            {
                notices.Add(notice);
            }
        }

        var (origin, meshOrigin) = (MiddleOf(model.Bounds), MiddleOf(mesh.Bounds));
        var batches = FaceBatches.Of(model, textures, settings.SkipsEmptyFaces);
        var (vertices, textureCoordinates, indices) = DrawableMeshBuilder.Build(mesh, meshOrigin, settings.CreaseAngle, batches);
        // What is transparent lets the inner sides of a solid be seen.
        var isWorthIt = detail is not null ? model is FractalModel || mesh.FaceCount <= CheckedFaces : maps.Length >= CheckedInstances;
        var meshSign = isWorthIt && !batches.Batches.Any(static batch => batch.IsTransparent) && ClosedSurface.IsSolid(mesh) ? 1 : 0;
        var commonSign = detail is null ? CommonSign(maps) : CommonSign(model);
        return new(name, origin, model.Bounds, vertices, indices, detail is null || model is MeshModel ? Rows(maps, meshOrigin, origin) : [])
        {
            Detail = detail,
            MeshOrigin = meshOrigin,
            TextureCoordinates = textureCoordinates,
            Batches = batches.Batches,
            EmptyFaces = batches.EmptyFaces,
            MeshSolidSign = meshSign,
            SolidSign = meshSign * commonSign,
        };
    }

    /// <summary>The box that stands for a model until it is prepared.</summary>
    private static DrawableModel Placeholder(Model model)
    {
        var (name, box) = (Path.GetFileName(model.Path), model.Bounds);
        if (model.Mesh.FaceCount == 0 || box.IsEmpty || !box.Size.IsFinite())
        {
            return new(name, Vector.Zero, BoundingBox.Empty, [], [], []) { IsPlaceholder = true };
        }

        var mesh = BoxMesh(box);
        var batches = FaceBatches.Of(mesh);
        var (vertices, _, indices) = DrawableMeshBuilder.Build(mesh, box.Centre, 0, batches);
        return new(name, box.Centre, box, vertices, indices, Rows([AffineMap.Identity], box.Centre, box.Centre)) { Batches = batches.Batches, IsPlaceholder = true };
    }

    private static Mesh BoxMesh(BoundingBox box)
    {
        var ((x1, y1, z1), (x2, y2, z2)) = (box.Minimum, box.Maximum);
        return new(
            [x1, y1, z1, x2, y1, z1, x1, y2, z1, x2, y2, z1, x1, y1, z2, x2, y1, z2, x1, y2, z2, x2, y2, z2],
            [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 4, 2, 4, 6, 2, 1, 3, 5, 3, 7, 5, 2, 6, 3, 3, 6, 7, 0, 1, 4, 1, 5, 4]);
    }

    /// <summary>The levels that instances are chosen from; null where they have no bounds, so that instances must be written out.</summary>
    private static DetailTable? TableOf(string name, Model model, ImmutableArray<string>.Builder notices)
    {
        try
        {
            return model is FractalModel { Fractal: var fractal } ? DetailTable.Of(fractal) : DetailTable.Of(model.Mesh);
        }
        catch (Exception exception) when (exception is FractalLimitException or SingularMatrixException)
        {
            notices.Add($"{name}: {exception.Message}");
            return null;
        }
    }

    /// <summary>The sign that the determinants of all instances' maps have; 0 where it differs or depends on the depth.</summary>
    private static int CommonSign(Model model) => model is not FractalModel { Fractal.Description.KeepsOrientation: false } ? 1 : 0;

    /// <summary>The sign that the determinants of all maps have; 0 when they differ or one is flat.</summary>
    private static int CommonSign(ImmutableArray<AffineMap> maps)
    {
        var sign = Math.Sign(maps[0].Linear.Determinant());
        foreach (ref readonly var map in maps.AsSpan())
        {
            if (Math.Sign(map.Linear.Determinant()) != sign)
            {
                return 0;
            }
        }

        return sign;
    }

    /// <summary>The origin where there is no middle: an unbounded fractal has none.</summary>
    private static Vector MiddleOf(BoundingBox box) => box.Centre is var centre && centre.IsFinite() ? centre : Vector.Zero;

    /// <summary>The maps between the shifted frames, by rows. Shifted in double precision, before anything is rounded.</summary>
    private static float[] Rows(ImmutableArray<AffineMap> maps, Vector meshOrigin, Vector origin)
    {
        var rows = new float[maps.Length * DrawableModel.InstanceFloats];
        var next = rows.AsSpan();
        foreach (ref readonly var map in maps.AsSpan())
        {
            var (v1, v2, v3) = map.Linear;
            var t = (map * meshOrigin) - origin;
            (next[0], next[1], next[2], next[3]) = ((float)v1.X, (float)v2.X, (float)v3.X, (float)t.X);
            (next[4], next[5], next[6], next[7]) = ((float)v1.Y, (float)v2.Y, (float)v3.Y, (float)t.Y);
            (next[8], next[9], next[10], next[11]) = ((float)v1.Z, (float)v2.Z, (float)v3.Z, (float)t.Z);
            next = next[DrawableModel.InstanceFloats..];
        }

        return rows;
    }
}
