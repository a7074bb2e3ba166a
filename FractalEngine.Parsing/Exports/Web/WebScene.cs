using System.Collections.Immutable;
using System.Globalization;
using System.Text.Json;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;

namespace FractalEngine.Parsing.Exports.Web;

/// <summary>A scene as a page keeps it, in JSON: camera, lights, materials, meshes, levels, objects and numbers.</summary>
/// <remarks>All colours are linear light.</remarks>
internal sealed class WebScene
{
    // The shape of the image for which a camera frames the scene.
    private const double Aspect = 16 / 9.0;

    // Sixteen fit the shader, as in drawn images.
    private const int MaxLights = 16;

    // That of drawn images.
    private static readonly Colour DefaultBackground = new(0.118, 0.133, 0.161);

    private readonly LoadedScene _scene;
    private readonly ExportSettings _settings;
    private readonly ISet<string> _losses;
    private readonly ImmutableArray<PlacedModel> _objects;
    private readonly List<Model> _models;
    private readonly List<WebLevels> _levels;
    private readonly List<Material> _materials = [];
    private readonly List<MaterialTexture> _textures = [];
    private int _sliders;

    /// <summary>Lists the models of a scene, with their levels.</summary>
    /// <param name="scene">Scene whose objects have their models.</param>
    /// <param name="settings">How its files were loaded.</param>
    /// <param name="losses">Receives what the page can't show, a sentence each.</param>
    public WebScene(LoadedScene scene, ExportSettings settings, ISet<string> losses)
    {
        _scene = scene;
        _settings = settings;
        _losses = losses;
        _objects = [.. scene.ByParts().Objects.Where(static placed => placed.Model.Mesh.FaceCount > 0)];
        _models = [.. _objects.Select(static placed => placed.Model).Distinct()];
        _levels = [.. _models.Select(static model => new WebLevels(
            model is FractalModel fractal ? fractal.Fractal : Core.Fractals.Fractal.Of(model.Mesh)))];
    }

    /// <summary>The title of the page.</summary>
    public string Title => _models.Count == 1 ? Path.GetFileNameWithoutExtension(_models[0].Name) : "scene";

    /// <summary>What the page holds, in a few words.</summary>
    public string Describe() => string.Create(
        CultureInfo.InvariantCulture,
        $"{Count(_objects.Length, "object")}, {Count(_levels.Sum(static one => one.Count), "level")}, {Count(_sliders, "slider")}");

    /// <summary>Writes the data of the page, shaders included.</summary>
    /// <returns>JSON, UTF-8.</returns>
    public byte[] Write()
    {
        using var stream = new MemoryStream();
        using (var json = new Utf8JsonWriter(stream))
        {
            json.WriteObject(null, () =>
            {
                WebPage.WriteShaders(json);
                WriteView(json);
                WriteLights(json);
                json.WriteObjects("meshes", _models, model => new WebMesh(model).Write(json, NumberOf));
                json.WriteObjects("fractals", _levels, levels => WriteLevels(json, levels));
                WriteObjects(json);
                WriteMaterials(json);
                _sliders = new WebNumbers(_models, _levels, _settings.Load, _losses, _settings.Progress).Write(json);
            });
        }

        return stream.ToArray();
    }

    /// <summary>Writes levels as the properties of an object.</summary>
    public static void WriteLevels(Utf8JsonWriter json, WebLevels levels)
    {
        json.WritePropertyName("shape");
        json.WriteRawValue(levels.Shape);
        json.WriteNumbers("values", levels.Values);
    }

    private static string Count(int number, string noun) =>
        string.Create(CultureInfo.InvariantCulture, $"{number} {noun}{(number == 1 ? "" : "s")}");

    private void WriteView(Utf8JsonWriter json)
    {
        var scene = _scene.Scene;
        var camera = scene.Camera ?? CameraFraming.Default(_scene, scene.Aspect ?? Aspect);
        var bounds = _scene.Bounds.IsEmpty ? new(Vector.Zero, Vector.Zero) : _scene.Bounds;
        Lose(scene.Projection == Projection.Orthographic, "the page shows perspective, not an orthographic view");
        Lose(camera.Aperture > 0, "the page shows everything sharp, not by a lens");
        Lose(scene.Film is not null, "the page does not play the film");
        Lose(_objects.Any(static one => one.Declaration is PhysicsObject or { Motion: not null }), "in the page nothing moves by itself");
        json.WriteObject("camera", () =>
        {
            json.WriteVector("position", camera.Position);
            var (right, up, forward) = camera.LocalAxes;
            json.WriteNumbers("axes", [.. new[] { right, up, forward }.SelectMany(WebMesh.Components)]);
            json.WriteNumber("slope", camera.HalfHeightAtUnitDepth);
            json.WriteNumber("aspect", scene.Aspect ?? Aspect);
        });
        json.WriteVector("centre", bounds.Centre);
        json.WriteNumber("size", bounds.FiniteDiagonalOr(1));
    }

    private void WriteLights(Utf8JsonWriter json)
    {
        var scene = _scene.Scene;
        Lose(scene.HasAutoExposure, "the page keeps the exposure that the scene states, and does not find its own");
        Lose(scene.Sky is ImageSky, "the sky is no image in the page, but has the colours of its light");
        Lose(scene.Fog is { IsLit: true }, "haze has no shafts of light in the page");
        Lose(scene.Background is not null && scene.Sky is not null, "the page shows the sky, not the background before it");
        var ambient = SceneAmbient.Of(scene);
        json.WriteObject("ambient", () =>
        {
            json.WriteVector("above", ambient.Above);
            json.WriteVector("below", ambient.Below);
            json.WriteVector("curvature", ambient.Curvature);
        });
        if (scene.Sky is { } sky)
        {
            var radiance = sky.ToRadiance(scene.Handedness);
            json.WriteObject("sky", () =>
            {
                json.WriteVector("zenith", radiance.At(Vector.J));
                json.WriteVector("horizon", sky.HorizonRadiance);
                json.WriteVector("ground", radiance.At(-Vector.J));
            });
        }

        var background = (scene.Background ?? DefaultBackground).ToLinearVector();
        json.WriteVector("background", background);
        json.WriteNumbers("display", [(int)scene.Tone, scene.Exposure, scene.Fog?.Density ?? 0]);
        json.WriteVector("fog", scene.Fog?.Colour?.ToLinearVector() ?? scene.Sky?.HorizonRadiance ?? background);
        json.WriteObjects("lights", SceneLights.Of(_scene).Take(MaxLights), light =>
        {
            json.WriteVector("colour", light.Radiance);
            json.WriteVector("axis", light.Axis);
            if (light.Position is { } position)
            {
                Lose(light.HasSurface, "lamps with a surface shine from their middle in the page");
                json.WriteVector("position", position);
                json.WriteNumber("range", light.Range);
            }

            json.WriteNumbers("cone", light.HasCone ? [light.EdgeCosine, light.BrightCosine] : [-3, -2]);
        });
    }

    private void WriteObjects(Utf8JsonWriter json) => json.WriteObjects("objects", _objects.Index(), item =>
    {
        var (index, placed) = item;
        json.WriteNumber("model", _models.IndexOf(placed.Model));
        json.WriteNumbers("map", TransformRows.Of(placed.ObjectToWorld));
        var turnsOver = placed.ObjectToWorld.Linear.Determinant() < 0
            || placed.Model is FractalModel { Fractal.PreservesOrientation: false };
        json.WriteBoolean("isMirrored", turnsOver);
        json.WriteVector("colour", ObjectPalette.ColourOf(placed, index).ToLinearVector());
        var bounds = placed.Model is FractalModel { Fractal: var fractal } ? fractal.WholeBounds : placed.Model.Bounds;
        json.WriteNumbers("whole", [.. WebMesh.Components(bounds.Centre), .. WebMesh.Components(bounds.Size)]);
        if (placed.Gradient is { Kind: not GradientKind.None } gradient)
        {
            Lose(gradient.HasSurface, "a gradient changes colours in the page, but neither roughness nor glow");
            json.WriteNumber("gradient", (int)gradient.Kind);
            json.WriteNumbers("stops", gradient.Palette is { } palette
                ? palette.Stops.SelectMany(static stop => WebMesh.Components(stop.Colour.ToLinearVector()).Prepend(stop.Position))
                : [.. WebMesh.Components(ObjectPalette.ColourOf(placed, index).ToLinearVector()).Prepend(0),
                    .. WebMesh.Components(gradient.EndColour.ToLinearVector()).Prepend(1)]);
        }
    });

    private void WriteMaterials(Utf8JsonWriter json)
    {
        json.WriteObjects("materials", _materials, material =>
        {
            Lose(material.IsGlossy, "surfaces of materials are matt in the page: nothing is mirrored");
            Lose(material.DetailTexture is not null || material.OpacityTexture is not null,
                "the page shows textures of colours alone, not those of normals, heights or opacity");
            json.WriteVector("colour", material.Diffuse.ToLinearVector());
            json.WriteNumber("opacity", material.Opacity);
            json.WriteVector("ambient", new(material.Ambient.Red, material.Ambient.Green, material.Ambient.Blue));
            json.WriteVector("emission", new(material.Emission.Red, material.Emission.Green, material.Emission.Blue));
            if (material.Texture is { } texture)
            {
                var index = _textures.FindIndex(known => known.Path == texture.Path);
                if (index < 0)
                {
                    index = _textures.Count;
                    _textures.Add(texture);
                }

                json.WriteNumber("texture", index);
                json.WriteNumbers("place", [texture.Scale.U, texture.Scale.V, texture.Offset.U, texture.Offset.V]);
                json.WriteBoolean("clamp", texture.IsClamped);
            }
        });
        json.WriteList("textures", _textures, texture => json.WriteBase64StringValue(
            texture.Contents.IsEmpty ? File.ReadAllBytes(texture.Path) : texture.Contents.AsSpan()));
    }

    private int NumberOf(Material? material)
    {
        if (material is null)
        {
            return -1;
        }

        if (!_materials.Contains(material))
        {
            _materials.Add(material);
        }

        return _materials.IndexOf(material);
    }

    private void Lose(bool isLost, string sentence)
    {
        if (isLost)
        {
            _losses.Add(sentence);
        }
    }
}
