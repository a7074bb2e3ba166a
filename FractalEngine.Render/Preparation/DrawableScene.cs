using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Preparation;

/// <summary>
/// A scene prepared for the GPU: vertices, indices and instances as plain arrays. Preparation uses no GL, so that it can run on another
/// thread while a window stays responsive.
/// </summary>
public sealed class DrawableScene
{
    private readonly LodHierarchy? _joinedHierarchy;
    private readonly int[] _firstItems;

    private DrawableScene(
        LoadedScene source, LoadedScene parts, ImmutableArray<DrawableModel> models, ImmutableArray<DrawableObject> objects,
        ImmutableArray<string> notices, LodHierarchy? joinedHierarchy)
    {
        Source = source;
        Parts = parts;
        _joinedHierarchy = joinedHierarchy;
        _firstItems = FirstItems(source);
        Models = models;
        Objects = objects;
        HasGloss = models.Any(static model => model.Batches.Any(static batch => batch.Material?.Material.IsGlossy == true))
            || objects.Any(static item => item.SurfaceGradient is { IsGlossy: true });
        Notices = notices;
    }

    /// <summary>Scene that this was prepared from.</summary>
    public LoadedScene Source { get; }

    /// <summary>The same scene with each object by its meshes, in the order of <see cref="Objects"/>.</summary>
    public LoadedScene Parts { get; }

    /// <summary>Models of all objects, each once and by its meshes, in the order of their first use.</summary>
    public ImmutableArray<DrawableModel> Models { get; }

    /// <summary>Objects in the order of the scene, one of several meshes as so many, see <see cref="ItemsOf"/>.</summary>
    public ImmutableArray<DrawableObject> Objects { get; }

    /// <summary>Textures of all materials, each once.</summary>
    public ImmutableArray<DrawableTexture> Textures { get; private init; } = [];

    /// <summary>Whether any surface mirrors part of the light.</summary>
    internal bool HasGloss { get; }

    /// <summary>Sentences for the user about whatever is not drawn in full.</summary>
    public ImmutableArray<string> Notices { get; }

    /// <summary>Number of instances that are drawn in every frame, without culled ones.</summary>
    public long InstanceCount => Objects.Sum(item => (long)item.Model.InstanceCount);

    /// <summary>Number of triangles that are drawn in every frame, without those of culled instances.</summary>
    public long TriangleCount => Objects.Sum(item => item.Model.TriangleCount);

    /// <summary>The fractal that a camera can enter: the only object of the scene, if that is a fractal; null for none.</summary>
    public FractalLocation? SingleFractal =>
        Source.Objects is [{ Model: FractalModel, ObjectToWorld: var objectToWorld }]
            && (_joinedHierarchy ?? Objects[0].Model.LodHierarchy) is { } hierarchy
            ? new(0, hierarchy, objectToWorld) : null;

    /// <summary>The items of <see cref="Objects"/> that show an object of the scene.</summary>
    /// <param name="objectIndex">Index of the object in the scene, from 0.</param>
    public Range ItemsOf(int objectIndex) => _firstItems[objectIndex].._firstItems[objectIndex + 1];

    /// <summary>Prepares all models of a scene, and the light within its fractals.</summary>
    /// <param name="scene">Scene with its files loaded.</param>
    /// <param name="settings">Settings with the budgets and the crease angle.</param>
    /// <param name="progress">Receives a report before and after each model, on this thread; null for none.</param>
    /// <param name="cancellation">Cancels between two models, and within a fractal's light.</param>
    /// <exception cref="OperationCanceledException">Preparation was cancelled.</exception>
    /// <remarks>Without culling, time and memory grow with the instances: about 0.2 s and 150 MB a million.</remarks>
    public static DrawableScene Prepare(
        LoadedScene scene,
        RenderSettings settings,
        IProgress<PreparationProgress>? progress = null,
        CancellationToken cancellation = default)
    {
        var preparation = new ScenePreparation(scene, settings);
        preparation.PrepareAll(progress, cancellation);
        if (preparation.HasUnbakedSky(settings))
        {
            preparation.BakeSky(cancellation);
        }

        return preparation.Scene;
    }

    /// <summary>Creates a scene whose models are placeholder boxes.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="parts">The same by parts, see <see cref="LoadedScene.ByParts"/>.</param>
    /// <param name="notices">Sentences for the user.</param>
    internal static DrawableScene CreateWithPlaceholders(LoadedScene scene, LoadedScene parts, ImmutableArray<string> notices)
    {
        var models = parts.Models.ToDictionary(static model => model, ModelPreparation.CreatePlaceholder);
        var objects = scene.Objects.SelectMany((placed, index) =>
            placed.Parts.Select((part, mesh) => (Placed: part, Colour: ObjectPalette.ColourOf(part, index + mesh))));
        return new(
            scene,
            parts,
            [.. parts.Models.Select(model => models[model])],
            [.. parts.Objects.Zip(objects, (placed, one) => CreateObject(placed, one.Colour, models[placed.Model]))],
            notices,
            JoinedHierarchyOf(scene));
    }

    /// <summary>Builds what a camera enters where the only object is a fractal of several meshes; null for others.</summary>
    // Where there is none, the preparation of each mesh tells why.
    private static LodHierarchy? JoinedHierarchyOf(LoadedScene scene) =>
        scene.Objects is [{ Model: FractalModel { Fractal.HasSeveralMeshes: true } model }]
            ? ModelPreparation.TryBuildHierarchy(model.Name, model, ImmutableArray.CreateBuilder<string>()) : null;

    private static int[] FirstItems(LoadedScene scene)
    {
        var first = new int[scene.Objects.Length + 1];
        for (var i = 0; i < scene.Objects.Length; i++)
        {
            first[i + 1] = first[i] + scene.Objects[i].Model.Parts.Length;
        }

        return first;
    }

    /// <summary>Returns the scene with one of its models replaced.</summary>
    internal DrawableScene WithModel(
        DrawableModel oldModel, DrawableModel newModel, ImmutableArray<DrawableTexture> textures, ImmutableArray<string> notices) => new(
            Source,
            Parts,
            [.. Models.Select(model => model == oldModel ? newModel : model)],
            [.. Objects.Select(item => item.Model == oldModel ? item with { Model = newModel } : item)],
            notices,
            _joinedHierarchy)
        {
            Textures = textures,
        };

    private static DrawableObject CreateObject(PlacedModel placed, Colour colour, DrawableModel model)
    {
        var declaration = placed.Declaration;
        return new(declaration.Name ?? model.Name, model, placed.ObjectToWorld, colour)
        {
            Tint = declaration.Colour ?? Colour.White,
            Gradient = placed.Gradient,
            SurfaceGradient = placed.Gradient is { HasSurface: true, Kind: not GradientKind.None }
                && placed.Model is FractalModel { Fractal.Description.Composition: Composition.Affine } ? placed.Gradient : null,
            IsDynamic = placed.Model is MeshModel && (declaration is PhysicsObject || declaration.Motion is not null),
        };
    }
}
