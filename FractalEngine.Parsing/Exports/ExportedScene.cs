using System.Collections.Immutable;
using System.Globalization;
using FractalEngine.Core;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Parsing.Exports;

/// <summary>The meshes of a scene with all their instances, which formats write one after another.</summary>
/// <remarks>Where no two instances can coincide they are found while they are written, so that memory does not grow with them.</remarks>
public sealed class ExportedScene
{
    private readonly ExportSettings _settings;
    private readonly bool _hasPaths;

    private ExportedScene(LoadedScene scene, ExportSettings settings, AffineMap frame, bool hasPaths)
    {
        _settings = settings;
        _hasPaths = hasPaths;
        Parts = settings.MaxInstances is { } count ? ListLargest(scene, frame, count) :
        [
            .. scene.Objects.SelectMany((placed, index) => placed.Parts.Select((part, mesh) => List(part, index, mesh, frame))),
        ];
        FaceCount = Parts.Sum(static part => part.Count * part.Mesh.FaceCount);
        if (FaceCount > settings.MaxFaces)
        {
            throw new FractalLimitException(string.Create(
                CultureInfo.InvariantCulture, $"the scene has {FaceCount} faces, more than the limit of {settings.MaxFaces}"));
        }
    }

    /// <summary>The parts in the order of the objects, and of the meshes of each; those of an object stand together.</summary>
    public ImmutableArray<ExportedPart> Parts { get; }

    /// <summary>Number of faces of all instances.</summary>
    public long FaceCount { get; }

    /// <summary>Number of faces for the line that a command ends with.</summary>
    public string Contents => ExportSummary.OfFaces(FaceCount).Contents;

    /// <summary>Finds the instances of a scene, or as many large ones as the settings allow.</summary>
    /// <param name="scene">Scene whose fractals are finite, unless the settings say how many instances there may be.</param>
    /// <param name="settings">The limits.</param>
    /// <param name="frame">From world space to the file.</param>
    /// <param name="hasPaths">True to tell the paths of instances through the levels, where these are walked through.</param>
    /// <exception cref="FractalLimitException">The scene has more faces than allowed.</exception>
    public static ExportedScene Of(LoadedScene scene, ExportSettings settings, AffineMap frame, bool hasPaths = false)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ArgumentNullException.ThrowIfNull(settings);
        return new(scene, settings, frame, hasPaths);
    }

    /// <summary>Tells what a format loses of the surfaces of a scene, a sentence each.</summary>
    /// <param name="scene">The scene.</param>
    /// <param name="keepsTextures">Whether the format has textures.</param>
    public static ImmutableArray<string> LossesOf(LoadedScene scene, bool keepsTextures = false)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var losesTextures = !keepsTextures && scene.Models.SelectMany(static model => model.Parts)
            .SelectMany(static part => part.Materials.Values).Any(static material => material.IsTextured);
        var losesSurfaces = scene.Objects.Any(static placed => placed.ShownGradient is { HasSurface: true });
        return
        [
            .. losesTextures ? (string[])["textures are not written"] : [],
            .. losesSurfaces ? (string[])["roughness, metal and glow of gradients are not written"] : [],
        ];
    }

    private ExportedPart List(PlacedModel placed, int objectIndex, int meshIndex, AffineMap frame)
    {
        var (instances, count) = placed.Model is FractalModel { Fractal: var fractal }
            ? Enumerate(placed, fractal)
            : ([new MeshInstance(meshIndex, AffineMap.Identity, Tint.None)], 1);
        return Create(placed, objectIndex, meshIndex, frame, count, instances);
    }

    private ExportedPart Create(
        PlacedModel placed, int objectIndex, int meshIndex, AffineMap frame, long count, IEnumerable<MeshInstance> instances)
    {
        var toFile = frame * placed.ObjectToWorld;
        return new(placed, objectIndex, meshIndex, count, instances.Select(instance =>
        {
            _settings.Cancellation.ThrowIfCancellationRequested();
            return instance with { Map = toFile * instance.Map };
        }));
    }

    private (IEnumerable<MeshInstance> Instances, long Count) Enumerate(PlacedModel placed, Fractal fractal)
    {
        try
        {
            var (instances, count) = fractal.Enumerate(
                _settings.MaxFaces / Math.Max(1, fractal.BaseMesh.FaceCount), _hasPaths || placed.ShownGradient is not null);
            return (Graded(placed, instances), count);
        }
        catch (FractalLimitException exception)
        {
            throw new FractalLimitException(string.Create(
                CultureInfo.InvariantCulture,
                $"{placed.Model.Name} has more faces than the limit of {_settings.MaxFaces}: "
                + $"its base has {fractal.BaseMesh.FaceCount}, and {exception.Message}; --depth or --instances writes fewer"), exception);
        }
    }

    /// <summary>Mixes the colours of a gradient into instances whose paths are known; those of what has no levels are not.</summary>
    private static IEnumerable<MeshInstance> Graded(PlacedModel placed, IEnumerable<MeshInstance> instances)
    {
        if (placed is not { ShownGradient: { } gradient, Model: FractalModel { Fractal: var fractal } }
            || instances.FirstOrDefault().Path is null)
        {
            return instances;
        }

        var shading = new InstanceGradient(gradient, LodHierarchy.Build(fractal));
        return instances.Select(instance => instance with { Tint = instance.Tint.Then(TintOf(shading.ShadeOf(instance.Path?.ToArray()))) });

        Tint TintOf(GradientShade shade) => gradient.Palette is not null ? new(shade.Colour, 0)
            : new(shade.Factor * gradient.EndColour.ToLinearVector(), 1 - shade.Factor);
    }

    private ImmutableArray<ExportedPart> ListLargest(LoadedScene scene, AffineMap frame, long count)
    {
        var fractals = scene.Objects.Select(static placed => (
            Fractal: placed.Model is FractalModel { Fractal: var fractal } ? fractal : Fractal.Of(placed.Model.Mesh),
            Placement: placed.ObjectToWorld)).ToArray();
        if (fractals.Any(static one => one.Fractal.Description.Composition == Composition.Componentwise))
        {
            throw new FractalEngineException("the largest instances of what is composed componentwise are not known");
        }

        var found = InstanceEnumeration.ListLargest(fractals, count).ToLookup(static one => one.Fractal, static one => one.Instance);
        // A model of one mesh may have others without faces, which then count as that one.
        var byMesh = scene.Objects.Select((placed, index) => Graded(placed, found[index])
            .ToLookup(one => placed.Model.Parts.Length == 1 ? 0 : one.MeshIndex)).ToArray();
        return
        [
            .. scene.Objects.SelectMany((placed, index) => placed.Parts.Select(
                (part, mesh) => Create(part, index, mesh, frame, byMesh[index][mesh].Count(), byMesh[index][mesh]))),
        ];
    }
}
