using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Light;

/// <summary>
/// Compares drawn shadows with traced ones: for each light alone, every pixel whose surface faces it is lit or not, by a ray through the
/// middle of the pixel and one from there to the light.
/// </summary>
internal sealed class ShadowError
{
    // As the path tracer has them: how wide rays are, and how far from the surface they start.
    private const double FootprintPixels = 0.25;
    private const double ShadowSpread = 1e-3;
    private const double SurfaceOffset = 1e-9;

    // Out of 255: pixels that are darker without any shadow are not judged.
    private const int MinValue = 24;

    private readonly LoadedScene _scene;
    private readonly View _view;
    private readonly int _width;
    private readonly int _height;
    private readonly (RayHit Hit, double Radius)?[] _hits;
    private readonly SceneRayCaster _caster;

    /// <summary>Finds the surface at each pixel.</summary>
    public ShadowError(LoadedScene scene, View view, int width, int height)
    {
        (_scene, _view, _width, _height) = (scene, view, width, height);
        _caster = new(scene);
        _hits = new (RayHit, double)?[width * height];
        Parallel.For(0, height, static () => new QueryContext(), (y, _, context) =>
        {
            for (var x = 0; x < width; x++)
            {
                _hits[(y * width) + x] = FindHit(x, y, context);
            }

            return context;
        }, static _ => { });
    }

    /// <summary>Counts the pixels of all lights together.</summary>
    /// <param name="settings">How shadows are drawn.</param>
    /// <returns>Pixels that face a light, and those of them that are lit in one image and not in the other.</returns>
    public (int Facing, int Wrong) Count(RenderSettings settings)
    {
        var (facing, wrong) = (0, 0);
        settings = settings with { Samples = 0, AmbientOcclusion = false };
        using var renderer = Renderer.Offscreen(_width, _height, settings);
        using var plainRenderer = Renderer.Offscreen(_width, _height, settings with { Shadows = false });
        foreach (var light in _scene.Scene.Lights.Where(light => light.ToEmitter() is not null && light.Intensity > 0))
        {
            var scene = LitBy(light);
            var (lightFacing, lightWrong) = Count(light, renderer.Draw(scene, _view), plainRenderer.Draw(scene, _view));
            facing += lightFacing;
            wrong += lightWrong;
        }

        return (facing, wrong);
    }

    private LoadedScene LitBy(Core.Scenes.Lights.Light light) => _scene with
    {
        Scene = _scene.Scene with
        {
            Lights = [light with { Colour = Colour.White, Intensity = light.ToEmitter()!.Position is null ? 1 : light.Intensity }],
            Sky = null,
            Fog = null,
            Tone = Tone.None,
            Exposure = 1,
            Background = Colour.Black,
        },
    };

    private (int Facing, int Wrong) Count(Core.Scenes.Lights.Light light, PixelImage drawn, PixelImage plain)
    {
        var (facing, wrong) = (0, 0);
        Parallel.For(0, _height, static () => new QueryContext(), (y, _, context) =>
        {
            var (rowFacing, rowWrong) = (0, 0);
            for (var x = 0; x < _width; x++)
            {
                var brightest = Brightest(plain, x, y);
                if (_hits[(y * _width) + x] is not var (hit, radius) || brightest < MinValue
                    || IsLit(light, in hit, radius, context) is not { } isLit)
                {
                    continue;
                }

                rowFacing++;
                rowWrong += isLit != IsLit(Brightest(drawn, x, y), brightest) ? 1 : 0;
            }

            Interlocked.Add(ref facing, rowFacing);
            Interlocked.Add(ref wrong, rowWrong);
            return context;
        }, static _ => { });
        return (facing, wrong);
    }

    private static int Brightest(PixelImage image, int x, int y)
    {
        var (red, green, blue, _) = image[x, y];
        return Math.Max(red, Math.Max(green, blue));
    }

    /// <summary>Half of the linear light counts as lit.</summary>
    private static bool IsLit(int value, int fullValue) =>
        new Colour(value / 255.0, 0, 0).ToLinear().Red > 0.5 * new Colour(fullValue / 255.0, 0, 0).ToLinear().Red;

    private (RayHit Hit, double Radius)? FindHit(int x, int y, QueryContext context)
    {
        var halfHeight = _view.Camera.HalfHeightAtUnitDepth;
        var up = -((((y + 0.5) / _height) * 2) - 1) * halfHeight;
        var right = ((((x + 0.5) / _width) * 2) - 1) * halfHeight * _width / _height;
        var direction = _view.Camera.LocalAxes * new Vector(right, up, 1);
        var footprint = new RayFootprint(0, FootprintPixels * 2 * halfHeight / _height / direction.Length());
        var ray = new Ray(_view.Camera.Position, direction.UnitVector());
        return _caster.TryFindNearest(ray, context, out var hit, 0, double.PositiveInfinity, footprint)
            ? (hit, footprint.RadiusAt((hit.Point - ray.Origin).Length()))
            : null;
    }

    /// <summary>Tells whether a light arrives; null where the surface does not face it.</summary>
    private bool? IsLit(Core.Scenes.Lights.Light light, in RayHit hit, double radius, QueryContext context)
    {
        var normal = hit.IsFrontFace ? hit.Normal : -hit.Normal;
        var origin = hit.Point + (SurfaceOffset * _scene.Bounds.Diagonal * normal);
        light.ToEmitter()!.Incoming(origin, out var toLight, out var distance);
        if (!(Vector.Dot(normal, toLight) > 0))
        {
            return null;
        }

        return !_caster.HitsAny(new(origin, toLight), context, 0, distance, new(radius, ShadowSpread));
    }
}
