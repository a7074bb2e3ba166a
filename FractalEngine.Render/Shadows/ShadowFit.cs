using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Shadows;

/// <summary>Decides which depth maps the lights of a scene need, and what each of them shows.</summary>
/// <remarks>
/// Parallel light has one map, or up to three for slices of a deep view, the nearest first. A spot light has one, a point light one for
/// each side of a cube that faces something visible. <see cref="ShadowMapSizes"/> divides the texels among them.
/// </remarks>
internal sealed class ShadowFit
{
    /// <summary>Maximum number of maps of all lights together.</summary>
    public const int MaxViews = 32;

    // Near planes of lights with a position, as a fraction of their range.
    private const double NearByRange = 1e-4;

    // Slices begin at no less than this part of the farthest depth, and the second and third slice come from these ratios on.
    private const double MinSliceRatio = 1.0 / 60;
    private const double TwoSlicesRatio = 3;
    private const double ThreeSlicesRatio = 8;

    // By depth: a texel beyond each edge, as a point is compared with four.
    private const double CubeSideHalfSize = 1.01;

    private static readonly (Vector Forward, Vector Up)[] CubeSides =
    [
        (Vector.I, Vector.J), (-Vector.I, Vector.J), (Vector.J, Vector.K), (-Vector.J, Vector.K),
        (Vector.K, Vector.J), (-Vector.K, Vector.J),
    ];

    private readonly ConvexRegion _region = new();
    private readonly List<double> _weights = [];
    private bool _keepsIdleViews;
    private bool _isAirLit;

    /// <summary>Views of the depth maps, those of one light after those of another.</summary>
    public List<ShadowView> Views { get; } = [];

    /// <summary>For each light, the index of its first view and their number; without any where it casts no shadow.</summary>
    public List<(int First, int Count)> Ranges { get; } = [];

    /// <summary>Lights with a position that are so far away that they are parallel: bit i for light i.</summary>
    public int DistantLights { get; private set; }

    /// <summary>Number of maps that are not needed: their light is dark, or lights nothing visible.</summary>
    public int SkippedCount { get; private set; }

    /// <summary>Computes the views for a frame.</summary>
    /// <param name="lights">Lights in the order of the light block.</param>
    /// <param name="frame">View of the frame.</param>
    /// <param name="origin">Position of the camera: its own, or zero where all is relative to it.</param>
    /// <param name="unitsPerSceneUnit">1, or more where the frame is drawn in a smaller unit about the camera.</param>
    /// <param name="receivers">Bounds of what shadows fall on.</param>
    /// <param name="casters">Bounds of what casts them.</param>
    /// <param name="fitsToView">Whether maps show only what the frame shows.</param>
    /// <param name="cullsLights">Whether maps that are not needed have no view; otherwise they have idle ones.</param>
    /// <param name="isAirLit">Whether shadows show in the air too: maps of the whole scene then serve where others end.</param>
    public void Fit(
        ImmutableArray<Emitter> lights, in FrameView frame, Vector origin, double unitsPerSceneUnit, BoundingBox receivers,
        BoundingBox casters, bool fitsToView, bool cullsLights = true, bool isAirLit = false)
    {
        _keepsIdleViews = !cullsLights;
        _isAirLit = isAirLit;
        SkippedCount = 0;
        DistantLights = 0;
        Views.Clear();
        _weights.Clear();
        Ranges.Clear();
        var hasShadows = !receivers.IsEmpty && receivers.Size.IsFinite() && receivers.Diagonal > 0 && casters.Size.IsFinite();
        foreach (var light in lights)
        {
            var first = Views.Count;
            if (hasShadows)
            {
                AddViews(light, in frame, origin, unitsPerSceneUnit, receivers, casters, fitsToView);
            }

            if (Views.Count > MaxViews && _keepsIdleViews)
            {
                // Idle views take the place of no others.
                Fit(lights, in frame, origin, unitsPerSceneUnit, receivers, casters, fitsToView, isAirLit: isAirLit);
                return;
            }

            if (Views.Count > MaxViews)
            {
                Views.RemoveRange(first, Views.Count - first);
                _weights.RemoveRange(first, _weights.Count - first);
            }

            Ranges.Add((first, Views.Count - first));
        }

        ShadowMapSizes.Assign(Views, _weights, frame.Width, frame.Height);
        ShadowMapSizes.Snap(Views);
    }

    /// <summary>Gives all views the plane that cuts the scene open, about their own eyes.</summary>
    /// <param name="section">
    /// In the frame of the views, which does not follow the camera unless that is in a deep zoom; null for none.
    /// </param>
    public void CutViews(SectionPlane? section)
    {
        for (var i = 0; section is { } plane && i < Views.Count; i++)
        {
            Views[i] = Views[i] with { Section = plane.About(Views[i].Position) };
        }
    }

    /// <summary>Takes all views away, as nothing casts a shadow. Lights keep their places.</summary>
    public void Clear()
    {
        Views.Clear();
        for (var i = 0; i < Ranges.Count; i++)
        {
            Ranges[i] = (0, 0);
        }
    }

    /// <summary>Returns axes whose third is a direction.</summary>
    private static Matrix AxesAlong(Vector forward, Vector up)
    {
        var right = Vector.Cross(up, forward).UnitVector();
        return new(right, Vector.Cross(forward, right), forward);
    }

    private void AddViews(
        Emitter light, in FrameView frame, Vector origin, double unitsPerSceneUnit, BoundingBox receivers, BoundingBox casters,
        bool fitsToView)
    {
        var weight = Math.Max(light.Radiance.X, Math.Max(light.Radiance.Y, light.Radiance.Z));
        if (light.Position is not { } place)
        {
            AddParallelViews(light.Axis, in frame, origin, receivers, casters, fitsToView, weight);
            return;
        }

        var position = frame.View.DeepZoom is null ? place : unitsPerSceneUnit * (place - frame.View.Camera.Position);
        var range = unitsPerSceneUnit * light.Range;
        var distance = Math.Sqrt(receivers.DistanceSquared(position));
        if (distance > 100 * receivers.Diagonal)
        {
            // From so far away the light is parallel.
            DistantLights |= 1 << Ranges.Count;
            AddParallelViews((receivers.Centre - position).UnitVector(), in frame, origin, receivers, casters, fitsToView, weight);
            return;
        }

        var far = Math.Min(range, distance + receivers.Diagonal);
        if (distance >= far)
        {
            weight = 0;
        }

        SetRegion(in frame, origin, frame.Near, frame.Far, receivers, fitsToView && !_isAirLit);
        var near = NearByRange * Math.Min(range, receivers.Diagonal);
        if (!light.NeedsCube)
        {
            var halfSize = Math.Tan(0.5 * light.ConeAngle * Math.PI / 180) * 1.01;
            var up = Math.Abs(light.Axis.Y) > 0.9 ? Vector.K : Vector.J;
            AddPerspectiveView(position, AxesAlong(light.Axis, up), halfSize, near, far, weight, isCubeSide: false);
            return;
        }

        foreach (var (forward, up) in CubeSides)
        {
            AddPerspectiveView(position, AxesAlong(forward, up), CubeSideHalfSize, near, far, 0.5 * weight, isCubeSide: true);
        }
    }

    /// <summary>Adds a view of a light with a position, if anything visible lies within it.</summary>
    private void AddPerspectiveView(
        Vector position, Matrix axes, double halfSize, double near, double far, double weight, bool isCubeSide)
    {
        var toView = axes.Transpose();
        var (right, left, above, below, before) = (true, true, true, true, true);
        foreach (var corner in _region.Corners)
        {
            var (x, y, z) = toView * (corner - position);
            right &= x > halfSize * z;
            left &= -x > halfSize * z;
            above &= y > halfSize * z;
            below &= -y > halfSize * z;
            before &= z < near;
        }

        var isVisible = _region.Corners.Length > 0 && !(right || left || above || below || before);
        var view = new ShadowView(position, axes, true, halfSize, halfSize, near, far, near, 0) { IsCubeSide = isCubeSide };
        AddView(in view, isVisible ? weight : 0);
    }

    private void AddParallelViews(
        Vector direction, in FrameView frame, Vector origin, BoundingBox receivers, BoundingBox casters, bool fitsToView, double weight)
    {
        var axes = AxesAlong(direction, Math.Abs(direction.Y) > 0.99 ? Vector.K : Vector.J);
        SetRegion(in frame, origin, frame.Near, frame.Far, receivers, fitsToView);
        if (_region.Corners.Length > 0)
        {
            AddSlices(in axes, in frame, origin, receivers, casters, fitsToView, weight);
        }
        else if (!_isAirLit)
        {
            SkippedCount++;
        }

        if (_isAirLit && fitsToView)
        {
            _region.SetBox(receivers);
            AddView(ParallelShadowView.Create(axes, _region.Corners, receivers, casters), weight);
        }
    }

    /// <summary>Adds the views for slices of the region, the nearest first.</summary>
    private void AddSlices(
        in Matrix axes, in FrameView frame, Vector origin, BoundingBox receivers, BoundingBox casters, bool fitsToView, double weight)
    {
        var (near, far) = DepthRange(in frame, origin);
        var ratio = far / Math.Max(near, MinSliceRatio * far);
        var sliceCount = !fitsToView || frame.View.Projection == Projection.Orthographic || ratio < TwoSlicesRatio ? 1
            : ratio < ThreeSlicesRatio ? 2
            : 3;
        for (var i = 0; i < sliceCount; i++)
        {
            if (sliceCount > 1)
            {
                var start = i == 0 ? near : far * Math.Pow(ratio, ((double)i / sliceCount) - 1);
                SetRegion(in frame, origin, start, far * Math.Pow(ratio, ((i + 1.0) / sliceCount) - 1), receivers, fitsToView);
            }

            if (_region.Corners.Length > 0)
            {
                AddView(ParallelShadowView.Create(axes, _region.Corners, receivers, casters), weight);
            }
        }
    }

    /// <summary>Adds a view, unless its light has no weight and is culled.</summary>
    private void AddView(in ShadowView view, double weight)
    {
        if (weight > 0 || _keepsIdleViews)
        {
            Views.Add(view with { IsIdle = !(weight > 0) });
            _weights.Add(weight);
        }
        else
        {
            SkippedCount++;
        }
    }

    private void SetRegion(in FrameView frame, Vector origin, double near, double far, BoundingBox receivers, bool fitsToView)
    {
        if (!fitsToView)
        {
            _region.SetBox(receivers);
            return;
        }

        var view = frame.View;
        _region.SetSlice(
            origin, view.Camera.LocalAxes, view.Projection == Projection.Perspective, view.HalfHeight * frame.Aspect, view.HalfHeight, near,
            far, receivers);
    }

    /// <summary>Returns the smallest and the largest depth of the region, as the camera sees it.</summary>
    private (double Near, double Far) DepthRange(in FrameView frame, Vector origin)
    {
        var forward = frame.View.Camera.LocalAxes.V3;
        var (near, far) = (double.PositiveInfinity, double.NegativeInfinity);
        foreach (var corner in _region.Corners)
        {
            var depth = Vector.Dot(forward, corner - origin);
            near = Math.Min(near, depth);
            far = Math.Max(far, depth);
        }

        return (near, far);
    }
}
