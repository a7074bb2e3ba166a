using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Passes;

namespace FractalEngine.Render.Shadows;

/// <summary>Decides which depth maps the lights of a scene need, and what each of them shows.</summary>
/// <remarks>
/// Parallel light has one map, or up to three for slices of a deep view, the nearest first. A spot light has one, a point light one for
/// each side of a cube that faces something visible. Maps of parallel light move by whole texels and change their size in steps, so that
/// edges of shadows stay where they are while a view turns.
/// </remarks>
internal sealed class ShadowFit
{
    /// <summary>Maximum number of maps of all lights together.</summary>
    public const int MaxViews = 32;

    // Side of the smallest and of the largest map, texels.
    private const int MinSize = 512;
    private const int MaxSize = 4096;

    // Of the largest map, by the longer side of the frame.
    private const double TexelsPerPixel = 3;

    // All maps together, texels.
    private const long MaxTexels = 2L * MaxSize * MaxSize;

    // The widest cone that has one map, degrees. Wider ones have sides of a cube.
    private const double MaxSpotAngle = 110;

    // Near planes of lights with a position, as a fraction of their range.
    private const double NearByRange = 1e-4;

    // Slices begin at no less than this part of the farthest depth, and the second and third slice come from these ratios on.
    private const double MinSliceRatio = 1.0 / 60;
    private const double TwoSlicesRatio = 3;
    private const double ThreeSlicesRatio = 8;

    // The size of a map of parallel light grows in steps of this factor.
    private const double SizeStep = 1.0905;

    // By depth: a texel beyond each edge, as a point is compared with four.
    private const double CubeSideHalfSize = 1.01;

    private static readonly (Vector Forward, Vector Up)[] CubeSides =
    [
        (Vector.I, Vector.J), (-Vector.I, Vector.J), (Vector.J, Vector.K), (-Vector.J, Vector.K),
        (Vector.K, Vector.J), (-Vector.K, Vector.J),
    ];

    private readonly ConvexRegion _region = new();
    private readonly List<ShadowView> _views = [];
    private readonly List<double> _weights = [];
    private bool _keepsIdleViews;

    /// <summary>Views of the depth maps, those of one light after those of another.</summary>
    public List<ShadowView> Views => _views;

    /// <summary>For each light, the index of its first view and their number; without any where it casts no shadow.</summary>
    public List<(int First, int Count)> Ranges { get; } = [];

    /// <summary>Lights with a position that are so far away that they are parallel: bit i for light i.</summary>
    public int DistantLights { get; private set; }

    /// <summary>Number of maps that are not needed: their light is dark, or lights nothing visible.</summary>
    public int SkippedCount { get; private set; }

    /// <summary>Whether a light has views of the sides of a cube, unless it is so far away that it is parallel.</summary>
    public static bool HasCube(Light light) => light is PointLight and not SpotLight { Angle: < MaxSpotAngle };

    /// <summary>Computes the views for a frame.</summary>
    /// <param name="lights">Lights in the order of the light block.</param>
    /// <param name="frame">View of the frame.</param>
    /// <param name="origin">Position of the camera: its own, or zero where all is relative to it.</param>
    /// <param name="unitsPerSceneUnit">1, or more where the frame is drawn in a smaller unit about the camera.</param>
    /// <param name="receivers">Bounds of what shadows fall on.</param>
    /// <param name="casters">Bounds of what casts them.</param>
    /// <param name="fitsToView">Whether maps show only what the frame shows.</param>
    /// <param name="cullsLights">Whether maps that are not needed have no view; otherwise they have idle ones.</param>
    public void Fit(
        ImmutableArray<Light> lights, in FrameView frame, Vector origin, double unitsPerSceneUnit, BoundingBox receivers,
        BoundingBox casters, bool fitsToView, bool cullsLights = true)
    {
        _keepsIdleViews = !cullsLights;
        SkippedCount = 0;
        DistantLights = 0;
        _views.Clear();
        _weights.Clear();
        Ranges.Clear();
        var hasShadows = !receivers.IsEmpty && receivers.Size.IsFinite() && receivers.Diagonal > 0 && casters.Size.IsFinite();
        foreach (var light in lights)
        {
            var first = _views.Count;
            if (hasShadows)
            {
                AddViews(light, in frame, origin, unitsPerSceneUnit, receivers, casters, fitsToView);
            }

            if (_views.Count > MaxViews && _keepsIdleViews)
            {
                // Idle views take the place of no others.
                Fit(lights, in frame, origin, unitsPerSceneUnit, receivers, casters, fitsToView);
                return;
            }

            if (_views.Count > MaxViews)
            {
                _views.RemoveRange(first, _views.Count - first);
                _weights.RemoveRange(first, _weights.Count - first);
            }

            Ranges.Add((first, _views.Count - first));
        }

        AssignSizes(frame.Width, frame.Height);
        for (var i = 0; i < _views.Count; i++)
        {
            _views[i] = _views[i].IsPerspective ? _views[i] : Snap(_views[i]);
        }
    }

    /// <summary>Takes all views away, as nothing casts a shadow. Lights keep their places.</summary>
    public void Clear()
    {
        _views.Clear();
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

    private static double WeightOf(Light light)
    {
        var (red, green, blue) = light.Colour.ToLinear();
        return light.Intensity * Math.Max(red, Math.Max(green, blue));
    }

    private void AddViews(
        Light light, in FrameView frame, Vector origin, double unitsPerSceneUnit, BoundingBox receivers, BoundingBox casters,
        bool fitsToView)
    {
        var weight = WeightOf(light);
        if (light is DirectionalLight directional)
        {
            AddParallelViews(directional.Direction.UnitVector(), in frame, origin, receivers, casters, fitsToView, weight);
            return;
        }

        var point = (PointLight)light;
        var position = frame.View.DeepZoom is null
            ? point.Position
            : unitsPerSceneUnit * (point.Position - frame.View.Camera.Position);

        var range = unitsPerSceneUnit * point.Range;
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

        SetRegion(in frame, origin, frame.Near, frame.Far, receivers, fitsToView);
        var near = NearByRange * Math.Min(range, receivers.Diagonal);
        if (!HasCube(light) && light is SpotLight spot)
        {
            var direction = spot.Direction.UnitVector();
            var halfSize = Math.Tan(0.5 * spot.Angle * Math.PI / 180) * 1.01;
            var up = Math.Abs(direction.Y) > 0.9 ? Vector.K : Vector.J;
            AddPerspectiveView(position, AxesAlong(direction, up), halfSize, near, far, weight, isCubeSide: false);
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
        if (_region.Corners.Length == 0)
        {
            SkippedCount++;
            return;
        }

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
                AddView(ParallelView(axes, receivers, casters), weight);
            }
        }
    }

    /// <summary>Adds a view, unless its light has no weight and is culled.</summary>
    private void AddView(in ShadowView view, double weight)
    {
        if (weight > 0 || _keepsIdleViews)
        {
            _views.Add(view with { IsIdle = !(weight > 0) });
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

    /// <summary>Returns a view of parallel light that shows the region, with all that may cast a shadow onto it.</summary>
    private ShadowView ParallelView(Matrix axes, BoundingBox receivers, BoundingBox casters)
    {
        var toLight = axes.Transpose();
        var minimum = double.PositiveInfinity * Vector.One;
        var maximum = -minimum;
        foreach (var corner in _region.Corners)
        {
            minimum = Vector.Min(minimum, toLight * corner);
            maximum = Vector.Max(maximum, toLight * corner);
        }

        var size = (maximum - minimum).MaxAbsComponent();
        var casterCentre = toLight * casters.Centre;
        var casterExtent = 0.5 * Vector.Dot(axes.V3.Absolute(), casters.Size);
        var casterNear = Math.Min(casterCentre.Z - casterExtent, minimum.Z);
        // A surface beyond the region may lie behind the same texels.
        var receiverFar = (toLight * receivers.Centre).Z + (0.5 * Vector.Dot(axes.V3.Absolute(), receivers.Size));
        // The eye stands before all casters, but not so far that floats about it lose a texel.
        var margin = (0.01 * size) + (0.01 * (maximum.Z - minimum.Z));
        var eyeDepth = Math.Max(casterNear, minimum.Z - (200 * size)) - margin;
        var centre = 0.5 * (minimum + maximum);
        var position = axes * new Vector(centre.X, centre.Y, eyeDepth);
        return new(
            position, axes, false, 0.5 * (maximum.X - minimum.X), 0.5 * (maximum.Y - minimum.Y), minimum.Z - margin - eyeDepth,
            Math.Max(receiverFar, maximum.Z) + margin - eyeDepth, casterNear - margin - eyeDepth, 0);
    }

    /// <summary>Gives the brightest lights the largest maps, within the limit of all texels.</summary>
    private void AssignSizes(int frameWidth, int frameHeight)
    {
        var largest = MinSize;
        while (largest < MaxSize && largest < TexelsPerPixel * Math.Max(frameWidth, frameHeight))
        {
            largest *= 2;
        }

        var brightest = 0.0;
        foreach (var weight in _weights)
        {
            brightest = Math.Max(brightest, weight);
        }

        for (var isWithinLimit = false; !isWithinLimit; largest /= 2)
        {
            var texels = 0L;
            for (var i = 0; i < _views.Count; i++)
            {
                var size = Math.Max(MinSize / 2, _weights[i] > 0.5 * brightest ? largest : largest / 2);
                _views[i] = _views[i] with { Size = size };
                texels += _views[i].IsIdle ? 0 : (long)size * size;
            }

            isWithinLimit = texels <= MaxTexels || largest <= MinSize;
        }
    }

    /// <summary>Rounds the size of a view up to a step, and moves it to a whole number of texels.</summary>
    private static ShadowView Snap(ShadowView view)
    {
        var halfWidth = RoundUpToStep(view.HalfWidth * (1 + (4.0 / view.Size)));
        var halfHeight = RoundUpToStep(view.HalfHeight * (1 + (4.0 / view.Size)));
        var (texelWidth, texelHeight) = (2 * halfWidth / view.Size, 2 * halfHeight / view.Size);
        var (x, y, z) = view.Axes.Transpose() * view.Position;
        var snapped = new Vector(texelWidth * Math.Round(x / texelWidth), texelHeight * Math.Round(y / texelHeight), z);
        return view with { Position = view.Axes * snapped, HalfWidth = halfWidth, HalfHeight = halfHeight };
    }

    private static double RoundUpToStep(double size) => Math.Pow(SizeStep, Math.Ceiling(Math.Log(size, SizeStep)));
}
