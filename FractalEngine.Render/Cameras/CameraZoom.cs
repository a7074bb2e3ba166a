using FractalEngine.Core.Geometry;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Cameras;

/// <summary>Flies a camera into a fractal, towards the surface straight ahead, so far in each step that nobody sees it.</summary>
public sealed class CameraZoom
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
    /// <param name="bounds">Bounds of the fractal in world space.</param>
    /// <param name="fractal">The fractal.</param>
    /// <param name="start">The view at the start, in perspective.</param>
    public CameraZoom(BoundingBox bounds, FractalLocation fractal, View start)
    {
        _start = start;
        _camera = new(bounds, start.Camera, start.Projection, null, fractal);
    }

    /// <summary>Counts the steps of a flight of so many levels, and returns to the start.</summary>
    /// <remarks>
    /// The levels behind the first are measured, since the flight begins anywhere in that one. So a flight of whole levels into a
    /// self-similar fractal ends with the image it began with, to the length of a step.
    /// </remarks>
    /// <exception cref="InvalidOperationException">The flight meets no surface, or the fractal is not so deep.</exception>
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

    private static InvalidOperationException NoSurface(int depth) => new(
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
