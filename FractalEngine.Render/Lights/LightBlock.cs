using System.Collections.Immutable;
using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Views;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Lights;

/// <summary>The lights of a scene in a uniform buffer, laid out as <c>LightBlock</c> in lighting.glsl (std140).</summary>
internal sealed class LightBlock : IDisposable
{
    /// <summary>Maximum number of lights that shine from somewhere. Ambient lights are added up and don't count.</summary>
    public const int MaxLights = 16;

    // Programs grow with the number of lights that have constant indices.
    private const int MaxUnrolledLights = 4;

    private const int HeaderFloats = 32;
    private const int SideFloats = 24;
    private const int FloatsPerLight = 16;

    private readonly Scene _scene;
    private readonly ImmutableArray<Emitter> _lights;
    private readonly double _fogDensity;
    private readonly RedundancyFilter _uploadFilter;
    private readonly GlBuffer _buffer;
    private readonly float[] _data = new float[HeaderFloats + (MaxLights * FloatsPerLight) + SideFloats];
    private (Vector, double, Colour, bool, ProbePlace?)? _lastKey;

    /// <summary>Creates the buffer for the lights of a scene, or for the default ones where it declares none.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="scene">Scene that declares lights, or whose bounds place the default ones.</param>
    public LightBlock(GlResources resources, LoadedScene scene)
    {
        _uploadFilter = resources.UploadFilter;
        _scene = scene.Scene;
        _lights = LightsOf(scene);
        _buffer = new(resources, "lights", BufferTarget.UniformBuffer);
        _fogDensity = scene.Scene.Fog?.Density ?? 0;
        WriteAmbient(SceneAmbient.Of(scene.Scene));
        HasAtmosphere = !DisplayTransform.Of(_scene).IsIdentity || _fogDensity > 0;
        MemoryMarshal.Cast<float, int>(_data.AsSpan(8))[0] = _lights.Length;
    }

    /// <summary>Whether surfaces are shown through haze, an exposure or a tone curve.</summary>
    public bool HasAtmosphere { get; }

    /// <summary>
    /// Returns the lights of a scene that shine from somewhere, the first <see cref="MaxLights"/> of them: those that it declares, or the
    /// default ones.
    /// </summary>
    public static ImmutableArray<Emitter> LightsOf(LoadedScene scene) => [.. SceneLights.Of(scene).Take(MaxLights)];

    /// <summary>Returns the bounds of all surfaces that are lights, world space; empty without any.</summary>
    public static BoundingBox SurfacesOf(LoadedScene scene) => LightsOf(scene).Aggregate(
        BoundingBox.Empty, static (bounds, light) => BoundingBox.Union(bounds, light.SurfaceBounds));

    /// <summary>
    /// Returns a loop over the lights, and the kinds of their shadows, as symbols of a shader. The loop over few lights has constant
    /// indices: without a GPU, reading a block at others takes a tenth to a fifth of a frame.
    /// </summary>
    /// <param name="scene">Scene that declares lights, sky and probe.</param>
    /// <param name="distantLights">Lights that have a position, but are parallel for the scene: bit i for light i.</param>
    public static string[] SymbolsOf(LoadedScene scene, int distantLights = 0)
    {
        var lights = LightsOf(scene);
        // It has one element at least, as GLSL has no arrays of none.
        var kinds = string.Join(", ", lights.Select(KindOfShadow).DefaultIfEmpty('0'));
        var loop = lights.Length <= MaxUnrolledLights
            ? string.Concat(Enumerable.Range(0, lights.Length).Select(static i => FormattableString.Invariant($" DO({i})")))
            : FormattableString.Invariant($" for (int i = 0; i < {lights.Length}; i++) {{ DO(i) }}");
        return
        [
            $"EACH_LIGHT(DO){loop}", $"LIGHT_KINDS int[]({kinds})",
            .. SymbolIf(scene.Scene.Sky is ImageSky, "SKY_SIDES"),
            .. SymbolIf(lights.Any(static light => light.HasSurface), "SURFACE_LIGHTS"),
            .. SymbolIf(scene.Scene.Probe is not null, "PROBE"),
        ];

        static string[] SymbolIf(bool isDefined, string symbol) => isDefined ? [symbol] : [];

        char KindOfShadow(Emitter light, int index) =>
            light.Position is null || (distantLights & (1 << index)) != 0 ? '0' : light.NeedsCube ? '1' : '2';
    }

    /// <summary>Returns the linear light that haze shines with: its own colour, or what stands at the horizon.</summary>
    /// <param name="scene">A scene.</param>
    /// <param name="background">Colour of the background where it declares none.</param>
    public static Vector FogColour(Scene scene, Colour background)
    {
        if (scene is { Fog.Colour: null, Sky: { } sky })
        {
            return sky.HorizonRadiance;
        }

        var colour = (scene.Fog?.Colour ?? scene.Background ?? background).ToLinearVector();
        return scene.Fog?.Colour is null ? DisplayTransform.Of(scene).Invert(colour) : colour;
    }

    /// <summary>
    /// Binds the block, uploading it at first and, with haze, a probe or a light that has a position, when one of these has changed.
    /// </summary>
    /// <param name="bindingPoint">Binding point of the program's block.</param>
    /// <param name="cameraPosition">Position of the camera in world space. Light positions are written relative to it.</param>
    /// <param name="unitsPerSceneUnit">1, or more where the frame is drawn in a smaller unit.</param>
    /// <param name="settings">The background where the scene declares none, and whether frames keep the scene's light.</param>
    /// <param name="probe">Reflection probe that mirrors show; null for none.</param>
    /// <param name="isForProbe">Whether light is left without haze.</param>
    public void Bind(
        int bindingPoint, Vector cameraPosition, double unitsPerSceneUnit, RenderSettings settings, ProbePlace? probe = null,
        bool isForProbe = false)
    {
        var key = (cameraPosition, unitsPerSceneUnit, _fogDensity > 0 ? settings.Background : default, settings.KeepsLight, probe);
        var isRedundant = _lastKey is { } last && (last == key || (last.Item4 == key.KeepsLight
            && !(_fogDensity > 0 || _scene.Probe is not null || _lights.Any(static light => light.Position is not null))));
        if (_uploadFilter.ShouldPerform(isRedundant))
        {
            for (var i = 0; i < _lights.Length; i++)
            {
                var target = _data.AsSpan(HeaderFloats + (i * FloatsPerLight), FloatsPerLight);
                WriteLight(_lights[i], cameraPosition, unitsPerSceneUnit, target);
            }

            var display = settings.KeepsLight ? DisplayTransform.Identity : DisplayTransform.Of(_scene);
            WriteVector(
                new(display.Exposure, (int)display.Tone, isForProbe ? 0 : _fogDensity / unitsPerSceneUnit), _scene.Fog?.Albedo ?? 0,
                _data.AsSpan(16));
            WriteVector(FogColour(_scene, settings.Background), _scene.Fog?.Anisotropy ?? 0, _data.AsSpan(20));
            if (probe is { } place)
            {
                WriteVector(place.Position - cameraPosition, place.InverseAtZero, _data.AsSpan(24));
            }

            _data[28] = (float)(probe?.InverseAtOne ?? 0);
            _buffer.Upload<float>(_data, BufferUsageHint.DynamicDraw);
            _lastKey = key;
        }

        _buffer.BindTo(bindingPoint);
    }

    /// <inheritdoc/>
    public void Dispose() => _buffer.Dispose();

    private static void WriteLight(Emitter light, Vector cameraPosition, double unitsPerSceneUnit, Span<float> target)
    {
        var kind = light.Position is null ? 0 : light.Radius > 0 ? 3 : light.HasSurface ? 4 : light.HasCone ? 2 : 1;
        WriteVector(light.HasSurface ? light.SurfaceRadiance : light.Radiance, kind, target);
        if (light.Position is { } position)
        {
            WriteVector(unitsPerSceneUnit * (position - cameraPosition), unitsPerSceneUnit * light.Range, target[4..]);
        }
        else
        {
            WriteVector(-light.Axis, 0, target[4..]);
        }

        WriteVector(light.Axis, light.BrightCosine, target[8..]);
        target[12] = (float)light.EdgeCosine;
        if (light.HasSurface)
        {
            WriteVector(unitsPerSceneUnit * light.HalfWidth, unitsPerSceneUnit * light.Radius, target[8..]);
            WriteVector(unitsPerSceneUnit * light.HalfHeight, 0, target[12..]);
        }
    }

    /// <summary>Writes a vector and a fourth number into the data of a uniform block.</summary>
    internal static void WriteVector(Vector v, double w, Span<float> target) =>
        (target[0], target[1], target[2], target[3]) = ((float)v.X, (float)v.Y, (float)v.Z, (float)w);

    private void WriteAmbient(SceneAmbient ambient)
    {
        WriteVector(ambient.Above, 0, _data);
        WriteVector(ambient.Below, 0, _data.AsSpan(4));
        WriteVector(ambient.Curvature, 0, _data.AsSpan(12));
        for (var i = 0; i < ambient.Sides.Length; i++)
        {
            WriteVector(ambient.Sides[i], 0, _data.AsSpan(_data.Length - SideFloats + (4 * i)));
        }
    }
}
