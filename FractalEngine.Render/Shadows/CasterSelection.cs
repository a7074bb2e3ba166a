using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Shadows;

/// <summary>Decides which objects need not be drawn into depth maps, since no shadow of theirs can be seen.</summary>
/// <remarks>
/// A point c shades only points c + t·d with t ≥ 0, where d is the way that light travels at c: the direction of parallel light, or c − p
/// of a light at p. Let n be the inward normal of a plane through o that bounds what is visible. If n·(c − o) &lt; 0 and n·d ≤ 0 at all
/// corners of an object's box, then both hold in all of the box, as they are linear in c. So n·(c + t·d − o) &lt; 0: all of the shadow is
/// outside. What neither shades itself nor can shade the box around all other objects needs no drawing either, by the same test.
/// </remarks>
internal sealed class CasterSelection
{
    // Texels around what is visible: pixels at the edge are compared with four texels, 1.3 texels towards the light.
    private const double MarginTexels = 4;

    // Objects may touch those that they do not shade, as a floor does: by the size of the scene.
    private const double TouchTolerance = 1e-9;

    private readonly List<(Vector Normal, double Offset)> _visiblePlanes = [];
    private readonly List<(Vector Normal, double Offset)> _otherPlanes = [];
    private BoundingBox[] _boundsBefore = [];
    private bool[] _isNeeded = [];
    private bool[] _isSelected = [];
    private FrameView _lastFrame;
    private bool _isInUse;

    /// <summary>Changes when maps lack an object that is needed now.</summary>
    public long Version { get; private set; }

    /// <summary>Number of objects that are not needed now.</summary>
    public int SkippedCount { get; private set; }

    /// <summary>Whether any object is needed now.</summary>
    public bool HasCasters => SkippedCount < _isNeeded.Length;

    /// <summary>Whether an object is drawn. What maps have already stays selected while the view does.</summary>
    public bool IsSelected(int index) => _isSelected[index];

    /// <summary>Selects the casters of a frame.</summary>
    /// <param name="scene">Scene as it is drawn.</param>
    /// <param name="bounds">Current bounds of its objects.</param>
    /// <param name="spheres">Spheres beside the objects.</param>
    /// <param name="sceneBounds">Bounds of all that is drawn.</param>
    /// <param name="frame">View of the frame.</param>
    /// <param name="fit">Views of the maps.</param>
    /// <param name="fitsToView">Whether the maps serve this view alone.</param>
    /// <param name="isOn">False to select all objects.</param>
    public void Update(
        DrawableScene scene, ReadOnlySpan<BoundingBox> bounds, IReadOnlyList<SphereInstance> spheres, BoundingBox sceneBounds,
        in FrameView frame, ShadowFit fit, bool fitsToView, bool isOn)
    {
        Resize(bounds.Length);
        Array.Fill(_isNeeded, !isOn);
        if (isOn)
        {
            SetVisiblePlanes(in frame, sceneBounds, fitsToView);
            UniteBefore(bounds);
            FindNeeded(scene, bounds, SphereBounds(spheres), in frame, fit);
        }

        SkippedCount = _isNeeded.AsSpan().Count(false);
        Select(mayShrink: !_isInUse || !isOn || (fitsToView && frame != _lastFrame));
        _lastFrame = frame;
        _isInUse = true;
    }

    private void Resize(int count)
    {
        if (_isNeeded.Length != count)
        {
            _isNeeded = new bool[count];
            _isSelected = new bool[count];
            _boundsBefore = new BoundingBox[count + 1];
            _isInUse = false;
        }
    }

    /// <summary>Notes a new version where an object is missing, or where the maps are probably drawn anew.</summary>
    private void Select(bool mayShrink)
    {
        var isMissing = false;
        for (var i = 0; i < _isNeeded.Length; i++)
        {
            isMissing |= _isNeeded[i] && !_isSelected[i];
        }

        if (isMissing)
        {
            Version++;
        }

        if (isMissing || mayShrink)
        {
            // Fewer than the maps have: at worst they are drawn again without need.
            _isNeeded.CopyTo(_isSelected, 0);
        }
    }

    /// <summary>Sets the planes around the scene, and around the frame where maps are for this view.</summary>
    private void SetVisiblePlanes(in FrameView frame, BoundingBox sceneBounds, bool fitsToView)
    {
        _visiblePlanes.Clear();
        AddSides(_visiblePlanes, sceneBounds);
        if (!fitsToView)
        {
            return;
        }

        var view = frame.View;
        var (right, up, forward) = view.Camera.LocalAxes;
        var (halfWidth, halfHeight) = (view.HalfHeight * frame.Aspect, view.HalfHeight);
        var position = view.Camera.Position;
        var isPerspective = view.Projection == Projection.Perspective;
        Add(right, halfWidth);
        Add(-right, halfWidth);
        Add(up, halfHeight);
        Add(-up, halfHeight);
        _visiblePlanes.Add((forward, Vector.Dot(forward, position)));

        void Add(Vector axis, double halfSize)
        {
            var normal = isPerspective ? (axis + (halfSize * forward)).UnitVector() : axis;
            _visiblePlanes.Add((normal, Vector.Dot(normal, position) - (isPerspective ? 0 : halfSize)));
        }
    }

    private static void AddSides(List<(Vector Normal, double Offset)> planes, BoundingBox box)
    {
        planes.Add((Vector.I, box.Minimum.X));
        planes.Add((Vector.J, box.Minimum.Y));
        planes.Add((Vector.K, box.Minimum.Z));
        planes.Add((-Vector.I, -box.Maximum.X));
        planes.Add((-Vector.J, -box.Maximum.Y));
        planes.Add((-Vector.K, -box.Maximum.Z));
    }

    private void UniteBefore(ReadOnlySpan<BoundingBox> bounds)
    {
        _boundsBefore[0] = BoundingBox.Empty;
        for (var i = 0; i < bounds.Length; i++)
        {
            _boundsBefore[i + 1] = BoundingBox.Union(_boundsBefore[i], bounds[i]);
        }
    }

    private static BoundingBox SphereBounds(IReadOnlyList<SphereInstance> spheres)
    {
        var bounds = BoundingBox.Empty;
        for (var i = 0; i < spheres.Count; i++)
        {
            bounds = BoundingBox.Union(bounds, spheres[i].Bounds);
        }

        return bounds;
    }

    private void FindNeeded(
        DrawableScene scene, ReadOnlySpan<BoundingBox> bounds, BoundingBox boundsAfter, in FrameView frame, ShadowFit fit)
    {
        for (var i = bounds.Length - 1; i >= 0; i--)
        {
            var box = bounds[i];
            var others = BoundingBox.Union(_boundsBefore[i], boundsAfter);
            boundsAfter = BoundingBox.Union(boundsAfter, box);
            if (box.IsEmpty || !scene.Objects[i].Model.HasCasterBatches)
            {
                continue;
            }

            var shadesItself = CanShadeItself(scene.Objects[i].Model, box, in frame);
            _otherPlanes.Clear();
            AddSides(_otherPlanes, others);
            for (var j = 0; j < fit.Views.Count && !_isNeeded[i]; j++)
            {
                var view = fit.Views[j];
                var margin = MarginTexels * view.TexelSize * (view.IsPerspective ? view.Far : 1);
                _isNeeded[i] = MayShade(in view, box, _visiblePlanes, -margin)
                    && (shadesItself || (!others.IsEmpty && MayShade(in view, box, _otherPlanes, TouchTolerance * others.Diagonal)));
            }
        }
    }

    /// <summary>Tells whether an object may shade what is seen of itself: a plane never does, a convex solid only within.</summary>
    private static bool CanShadeItself(DrawableModel model, BoundingBox box, in FrameView frame) =>
        !model.IsFlat && !(model.IsConvex && frame.Section is null && frame.View.IsBeyondDepth(box, frame.Near));

    /// <summary>Tells whether the shadow of a box may reach the inner side of all planes; see the remarks of this class.</summary>
    /// <param name="view">View of the light.</param>
    /// <param name="box">Bounds of the caster.</param>
    /// <param name="planes">Inward unit normals, and the heights of the planes along them.</param>
    /// <param name="maxHeight">Height over a plane up to which a box counts as outside.</param>
    private static bool MayShade(
        in ShadowView view, BoundingBox box, List<(Vector Normal, double Offset)> planes, double maxHeight)
    {
        if (!box.Size.IsFinite())
        {
            return true;
        }

        foreach (var (normal, offset) in planes)
        {
            var highest = Vector.Dot(normal, box.Centre) + (0.5 * Vector.Dot(normal.Absolute(), box.Size));
            var leadsAway = view.IsPerspective ? highest <= Vector.Dot(normal, view.Position) : Vector.Dot(normal, view.Axes.V3) <= 0;
            if (highest - offset <= maxHeight && leadsAway)
            {
                return false;
            }
        }

        return true;
    }
}
