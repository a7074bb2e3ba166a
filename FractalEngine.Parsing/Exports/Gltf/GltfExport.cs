using System.Text.Json.Nodes;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Parsing.Exports.Gltf;

/// <summary>
/// glTF 2.0 as one binary file: meshes once and their instances by <c>EXT_mesh_gpu_instancing</c>, materials with images, camera and
/// lights; right-handed with y up, in metres.
/// </summary>
/// <remarks>Coordinates are floats. Streamed, in several passes over the instances; memory as <see cref="ExportedScene"/>.</remarks>
public sealed class GltfExport : SceneExport
{
    private const double BrightPart = 0.9;
    private const double MinNear = 1e-6;

    /// <inheritdoc/>
    public override string Ending => ".glb";

    /// <inheritdoc/>
    protected override ExportSummary WriteCore(LoadedScene scene, ExportSettings settings, Stream stream)
    {
        var frame = ExportFrame.Right.From(scene, settings);
        var exported = ExportedScene.Of(scene, settings, frame);
        var document = new GltfDocument();
        var surfaces = new GltfSurfaces(document);
        var skewed = exported.Parts.Sum(part => new GltfPart(document, surfaces, part, settings.IsFlat).Add());
        AddView(document, scene.Scene, frame);
        document.Write(stream, settings.Progress);
        return new(exported.Contents)
        {
            Losses =
            [
                .. Tell(
                    settings.IsFlat ? 0 : skewed, "{0} skewed instances have faces of their own, since instances of glTF have no shear"),
                .. Tell(surfaces.LeftOutCount, "{0} textures are left out, since glTF has PNG and JPEG only"),
                .. Tell(
                    exported.Parts.SelectMany(static part => part.Placed.Model.Materials.Values).Distinct().Count(static one =>
                        one.OpacityTexture is not null || (one.BumpTexture is not null && one.NormalTexture is null)),
                    "images of opacity or heights are left out, in materials: {0}"),
                .. ExportedScene.LossesOf(scene, keepsTextures: true),
                .. LittleEndianWriter.LossesOf(scene, frame),
                .. Tell(
                    scene.Scene is { Camera: not null, Projection: Projection.Orthographic } ? 1 : 0,
                    "the camera is not written, since it is orthographic"),
                .. Tell(
                    SceneAmbient.Of(scene.Scene).IsDark || scene.Scene is { Sky: null, Lights.IsEmpty: true } ? 0 : 1,
                    "light from all around is not written"),
            ],
        };
    }

    private static string[] Tell(long count, string sentence) =>
        count == 0 ? [] : [string.Format(System.Globalization.CultureInfo.InvariantCulture, sentence, count)];

    private static void AddView(GltfDocument document, Scene scene, AffineMap frame)
    {
        var scale = Math.Cbrt(Math.Abs(frame.Linear.Determinant()));
        var turn = frame.Linear / scale;
        if (scene.Camera is { } camera && scene.Projection == Projection.Perspective)
        {
            var axes = turn * camera.LocalAxes;
            var index = document.Add("cameras", new()
            {
                ["type"] = "perspective",
                ["perspective"] = new JsonObject
                {
                    ["yfov"] = camera.FieldOfView * Math.PI / 180,
                    ["znear"] = Math.Max(MinNear, 1e-3 * scale),
                },
            });
            // A camera of glTF looks along its own −z.
            document.AddNode(Place(new(axes.V1, axes.V2, -axes.V3), frame * camera.Position), ("camera", index));
        }

        foreach (var emitter in scene.Lights.Select(static light => light.ToEmitter()).OfType<Emitter>())
        {
            AddLight(document, emitter, frame, turn, scale);
        }
    }

    /// <summary>Adds a light. Ours show a white surface white at 1, where glTF has lux and candela: π times as much.</summary>
    private static void AddLight(GltfDocument document, Emitter emitter, AffineMap frame, Matrix turn, double scale)
    {
        document.Use("KHR_lights_punctual");
        var strength = emitter.Radiance.MaxAbsComponent();
        var colour = strength > 0 ? emitter.Radiance / strength : Vector.One;
        var light = new JsonObject
        {
            ["type"] = emitter.Position is null ? "directional" : emitter.HasCone ? "spot" : "point",
            ["color"] = new JsonArray(colour.X, colour.Y, colour.Z),
            ["intensity"] = Math.PI * strength,
        };
        if (emitter.Position is not null)
        {
            // A tenth of the range is where a light of ours brings π times its radiance.
            var range = emitter.Range * scale;
            light["range"] = range;
            light["intensity"] = Math.PI * strength * 0.01 * range * range;
        }

        if (emitter.HasCone)
        {
            var angle = Math.Min(emitter.ConeAngle * Math.PI / 360, Math.PI / 2);
            light["spot"] = new JsonObject { ["outerConeAngle"] = angle, ["innerConeAngle"] = BrightPart * angle };
        }

        var lights = document.ExtensionArray("KHR_lights_punctual", "lights");
        lights.Add((JsonNode)light);
        var axis = emitter.Axis == Vector.Zero ? -Vector.K : (turn * emitter.Axis).UnitVector();
        var right = Vector.Cross(Math.Abs(axis.Y) < BrightPart ? Vector.J : Vector.I, -axis).UnitVector();
        var node = Place(new(right, Vector.Cross(-axis, right), -axis), frame * (emitter.Position ?? Vector.Zero));
        node["extensions"] = new JsonObject { ["KHR_lights_punctual"] = new JsonObject { ["light"] = lights.Count - 1 } };
        document.AddNode(node);
    }

    private static JsonObject Place(Matrix axes, Vector position) => new() { ["matrix"] = GltfDocument.MatrixOf(new(axes, position)) };
}
