using System.Collections.Immutable;
using FractalEngine.Core;
using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Tools;

/// <summary>Finds what is under a pixel of a frame, by the exact ray through it.</summary>
internal sealed class Picker
{
    // Deeper in a fractal, the position of the camera in world space is no longer exact beside the size of a pixel.
    private const double MaxLog10Magnification = 11;

    private readonly QueryContext _context = new();
    private LoadedScene? _scene;
    private SceneRayCaster? _caster;
    private DeepZoomRayCaster? _deepCaster;

    /// <summary>Finds the face under a pixel, behind the planes that cut the view open.</summary>
    /// <param name="scene">The scene with its bodies where they are.</param>
    /// <param name="view">View of the frame in world space, without a deep zoom.</param>
    /// <param name="pixel">Framebuffer pixels from the upper left corner.</param>
    /// <param name="size">Size of the frame in pixels.</param>
    /// <returns>The innermost part at the pixel; null where only the background is there.</returns>
    /// <exception cref="FractalEngineException">A model of the scene can't be searched.</exception>
    public Selection? Pick(LoadedScene scene, View view, (double X, double Y) pixel, (int Width, int Height) size)
    {
        TakeScene(scene);
        _caster ??= new(scene);
        var ray = view.RayThrough(pixel.X, pixel.Y, size.Width, size.Height);
        // The direction's part along the axis is 1, so that its length is the distance at a depth of 1.
        var (near, far) = view.FixedClipPlanes ?? (0, double.PositiveInfinity);
        var (minDistance, maxDistance) = (near * ray.Direction.Length(), far * ray.Direction.Length());
        if ((view.Section is { } section && !section.TryClip(in ray, ref minDistance, ref maxDistance))
            || !_caster!.TryFindNearest(ray, _context, out var hit, minDistance, maxDistance))
        {
            return null;
        }

        var objectIndex = _context.ObjectIndex;
        var path = _context.InstancePath;
        return new(objectIndex, scene.Objects[objectIndex], [.. path], path.Length, hit);
    }

    /// <summary>Finds the face under a pixel of a view so deep in a fractal that world space is too coarse for it.</summary>
    /// <param name="scene">The scene, whose only object is the fractal.</param>
    /// <param name="view">View of the frame with its deep zoom.</param>
    /// <param name="viewpoint">Address of the camera that the deep zoom was made of, and which has not moved since.</param>
    /// <param name="pixel">Framebuffer pixels from the upper left corner.</param>
    /// <param name="size">Size of the frame in pixels.</param>
    /// <inheritdoc cref="Pick"/>
    public Selection? PickDeep(
        LoadedScene scene, View view, FractalAddress viewpoint, (double X, double Y) pixel, (int Width, int Height) size)
    {
        TakeScene(scene);
        var (objectIndex, roots, _) = view.DeepZoom!;
        var placed = scene.Objects[objectIndex];
        _deepCaster = _deepCaster?.WithRoots(roots) ?? new(((FractalModel)placed.Model).Fractal, roots);
        // All is about the camera.
        var aboutCamera = view with { Camera = view.Camera with { Position = Vector.Zero } };
        var ray = aboutCamera.RayThrough(pixel.X, pixel.Y, size.Width, size.Height);
        if (!_deepCaster.TryFindNearest(ray, _context, out var hit))
        {
            return null;
        }

        var address = viewpoint.RelativeTo(roots[_context.ObjectIndex]);
        ImmutableArray<int> path = [.. address.MapIndices, .. _context.InstancePath];
        return new(objectIndex, placed, path, path.Length, hit, address);
    }

    /// <summary>Tells whether positions in world space are exact enough at a magnification.</summary>
    public static bool IsExactAt(double log10Magnification) => log10Magnification <= MaxLog10Magnification;

    private void TakeScene(LoadedScene scene)
    {
        if (!ReferenceEquals(scene, _scene))
        {
            (_caster, _deepCaster) = (null, null);
            _scene = scene;
        }
    }
}
