using FractalEngine.App.Shell;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Cameras;

/// <summary>Flies a camera into a fractal, towards the surface ahead, as the wheel in the window does.</summary>
internal sealed class CameraZoom
{
    /// <summary>Maximum number of levels. Deeper, a flight takes minutes.</summary>
    public const int MaxLevels = 1_000;

    // So near 1 that nobody sees a step: a level takes hundreds of them.
    private const double StepFactor = 0.995;

    // A flight that gains no level in so many steps meets no surface.
    private const int MaxStepsPerLevel = 5_000;

    private readonly View _start;
    private readonly FlyingCamera _camera;
    private double _steps;

    /// <summary>Begins a flight at a view.</summary>
    /// <param name="drawable">A scene whose only object is a fractal.</param>
    /// <param name="start">The view at the start; must be in perspective.</param>
    /// <exception cref="UsageException">The scene has no single fractal, or the view is orthographic.</exception>
    public CameraZoom(DrawableScene drawable, View start)
    {
        if (drawable.Source.Objects is not [{ Model: FractalModel, ObjectToWorld: var objectToWorld }]
            || drawable.Objects[0].Model.LodHierarchy is not { } hierarchy)
        {
            throw new UsageException("--zoom needs a fractal, or a scene whose only object is one, and --detail above 0");
        }

        if (start.Projection != Projection.Perspective)
        {
            throw new UsageException("--zoom needs the perspective projection");
        }

        _start = start;
        _camera = new(drawable.Source.Bounds, start.Camera, start.Projection, null, new(0, hierarchy, objectToWorld));
    }

    /// <summary>Counts the steps of a flight of so many levels, and returns to the start.</summary>
    /// <remarks>
    /// The levels behind the first are measured, since the flight begins anywhere in that one. So a flight of whole levels into a
    /// self-similar fractal ends with the image it began with, to the length of a step.
    /// </remarks>
    /// <exception cref="UsageException">The flight meets no surface, or the fractal is not so deep.</exception>
    public double CountSteps(double levels)
    {
        var wholeLevels = (int)Math.Ceiling(levels);
        var stepsToFirst = CountStepsToLevel(1) ?? throw NoSurface(0);
        _camera.Reset();
        // The last level of a finite fractal has none behind it.
        var steps = CountStepsToLevel(wholeLevels + 1) - stepsToFirst;
        _camera.Reset();
        steps ??= CountStepsToLevel(wholeLevels) ?? throw NoSurface(_camera.Depth);
        _camera.Reset();
        _steps = 0;
        return steps.Value * levels / wholeLevels;
    }

    /// <summary>Flies on to a number of steps from the start.</summary>
    /// <param name="steps">No less than before.</param>
    /// <returns>The view there.</returns>
    public View FlyTo(double steps)
    {
        for (; _steps + 1 <= steps; _steps++)
        {
            _camera.Zoom(StepFactor);
        }

        if (steps > _steps)
        {
            _camera.Zoom(Math.Pow(StepFactor, steps - _steps));
            _steps = steps;
        }

        return _camera.WithDeepZoom(_start with { Camera = _camera.Camera });
    }

    private static UsageException NoSurface(int depth) => new(
        $"the camera gets only {depth} {(depth == 1 ? "level" : "levels")} deep: it "
        + $"meets no surface straight ahead, or the fractal ends there");

    /// <summary>Flies from the start until the camera is a number of levels deeper.</summary>
    /// <returns>The number of steps; null where the flight gets no farther before.</returns>
    private int? CountStepsToLevel(int level)
    {
        var (start, reached, stepsInLevel) = (_camera.Depth, _camera.Depth, 0);
        for (var steps = 0; ; steps++)
        {
            if (_camera.Depth > reached)
            {
                (reached, stepsInLevel) = (_camera.Depth, 0);
            }

            if (reached >= start + level || ++stepsInLevel > MaxStepsPerLevel)
            {
                return reached >= start + level ? steps : null;
            }

            _camera.Zoom(StepFactor);
        }
    }
}
