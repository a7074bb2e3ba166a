using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Frames;

/// <summary>
/// The view frustum of one strip of a frame: projects boxes from view space to pixels, and tests them against the frustum.
/// </summary>
/// <remarks>
/// This is where frustum culling of fractals and static meshes happens: a box outside the frustum has the footprint
/// <see cref="ScreenFootprint.Outside"/>, which culling skips. Meshes that physics moves are tested by the renderer, one box for each
/// object.
/// Pixels are those of the occlusion buffer: two by two for each pixel of the frame where pixels have several samples. Columns and rows
/// are counted from the upper left corner of the frame.
/// </remarks>
/// <param name="view">View of the whole frame.</param>
/// <param name="settings">Settings of culling.</param>
/// <param name="minProjectedSize">Projected size below which sub-fractals become proxies, pixels of the frame.</param>
/// <param name="instanceBudget">Number of instances after which the strip gives up.</param>
/// <param name="left">First column of the strip in the frame.</param>
/// <param name="right">One more than the last column.</param>
internal readonly struct StripFrame(
    in CullingView view, CullingSettings settings, double minProjectedSize, int instanceBudget, int left, int right)
{
    private const int MultisampleFactor = 2;

    // In pixels: more than the rounding of single precision.
    private const float PixelPadding = 1f / 256;

    // In pixels: how far beyond the edges of the strip a box of several objects must be.
    private const double GroupPadding = 1.0 / 64;

    // A strip gives up after so many nodes for each instance of the budget, or of this many.
    private const int MaxNodesPerInstance = 4;
    private const int MinInstancesForNodeLimit = 20_000;

    // Relative to coordinates: more than the rounding of the maps from objects to the view.
    private const double SectionMargin = 1e-12;

    private readonly Vector256<double> _sectionNormal = SimdAffineMap.ToVector256(SectionNormal(in view));
    private readonly Vector256<double> _sectionExtent = SimdAffineMap.ToVector256(SectionNormal(in view).Absolute());
    private readonly double _sectionDistance = view.Section?.Distance ?? 0;
    private readonly float _minSampleOffset = OcclusionBuffer.SampleOffsets(settings.IsMultisampled).Min - PixelPadding;
    private readonly float _maxSampleOffset = OcclusionBuffer.SampleOffsets(settings.IsMultisampled).Max + PixelPadding;

    /// <summary>Camera position, world space.</summary>
    public Vector Position { get; } = view.Position;

    /// <summary>Columns are the camera's right, up and forward axes in world space.</summary>
    public Matrix Axes { get; } = view.Axes;

    /// <summary>True for a perspective projection, false for an orthographic one.</summary>
    public bool IsPerspective { get; } = view.IsPerspective;

    /// <summary>Depth of the near plane, scene units.</summary>
    public double Near { get; } = view.Near;

    /// <summary>Depth of the far plane, scene units.</summary>
    public double Far { get; } = view.Far;

    /// <summary>Whether boxes outside the frustum are culled.</summary>
    public bool HasFrustumCulling { get; } = settings.FrustumCulling;

    /// <summary>Whether hidden boxes are culled.</summary>
    public bool HasOcclusionCulling { get; } = settings.OcclusionCulling;

    /// <summary>Whether boxes beyond a section plane are culled.</summary>
    public bool HasSection { get; } = view.Section is not null;

    /// <summary>Whether instances come with the parts of the sky that they see.</summary>
    public bool HasSkyVisibility { get; } = settings.SkyVisibility;

    /// <summary>Whether the camera's axes are right-handed.</summary>
    public bool IsMirrored { get; } = view.Axes.Determinant() < 0;

    /// <summary>Whether pixels of the frame have several samples.</summary>
    public bool IsMultisampled { get; } = settings.IsMultisampled;

    /// <summary>Projected size below which sub-fractals become proxies, pixels of the occlusion buffer.</summary>
    public double MinProjectedSize { get; } = SamplesPerAxis(settings) * minProjectedSize;

    /// <summary>Number of instances after which the strip gives up.</summary>
    public int InstanceBudget { get; } = instanceBudget;

    /// <summary>Number of visited nodes after which the strip gives up.</summary>
    public long MaxNodes { get; } = MaxNodesPerInstance * (long)Math.Max(instanceBudget, MinInstancesForNodeLimit);

    /// <summary>Pixels per unit to the right (at depth 1 in perspective).</summary>
    public double ScaleX { get; } = SamplesPerAxis(settings) * view.PixelsPerUnitX;

    /// <summary>Pixels per unit upwards (at depth 1 in perspective).</summary>
    public double ScaleY { get; } = SamplesPerAxis(settings) * view.PixelsPerUnitY;

    /// <summary>Horizontal coordinate of what lies straight ahead: the frame's centre, unless the image is moved.</summary>
    public double CentreX { get; } = SamplesPerAxis(settings) * ((0.5 * view.Width) + view.Offset.X);

    /// <summary>Vertical coordinate of what lies straight ahead.</summary>
    public double CentreY { get; } = SamplesPerAxis(settings) * ((0.5 * view.Height) - view.Offset.Y);

    /// <summary>First column of the strip.</summary>
    public int Left { get; } = SamplesPerAxis(settings) * left;

    /// <summary>One more than the last column of the strip.</summary>
    public int Right { get; } = SamplesPerAxis(settings) * right;

    /// <summary>Number of rows of the frame.</summary>
    public int Height { get; } = SamplesPerAxis(settings) * view.Height;

    /// <summary>Map from view space to world axes about the camera.</summary>
    public SimdAffineMap ViewToWorld { get; } = new(new AffineMap(view.Axes, Vector.Zero));

    /// <summary>Tells on which side of the section plane a box in view space lies.</summary>
    /// <param name="centre">Centre of the box: x, y, z, 0.</param>
    /// <param name="halfSize">Half the size of the box: x, y, z, 0.</param>
    public SectionSide SideOf(Vector256<double> centre, Vector256<double> halfSize)
    {
        var distance = Vector256.Dot(_sectionNormal, centre) - _sectionDistance;
        var reach = Vector256.Dot(_sectionExtent, halfSize);
        var margin = SectionMargin * (Math.Abs(distance) + reach + Math.Abs(_sectionDistance));
        return distance - reach > margin ? SectionSide.CutAway
            : distance + reach < -margin ? SectionSide.Kept
            : SectionSide.Cut;
    }

    /// <summary>Tests a box in view space against the frustum, and computes its footprint, in double precision.</summary>
    /// <param name="centre">Centre of the box: x, y, z, 0.</param>
    /// <param name="halfSize">Half the size of the box: x, y, z, 0.</param>
    public ScreenFootprint ProjectBox(Vector256<double> centre, Vector256<double> halfSize)
    {
        var low = centre - halfSize;
        var high = centre + halfSize;
        var zLow = low[2];
        var zHigh = high[2];
        if (HasFrustumCulling && (zHigh < Near || zLow > Far))
        {
            return ScreenFootprint.Outside;
        }

        if (zLow < Near)
        {
            // The size is that at the closest visible depth, or as far in front of the camera as the box reaches behind it.
            var maxExtent = 2 * Math.Max(halfSize[0] * ScaleX, halfSize[1] * ScaleY);
            var depth = Math.Max(Near, -zHigh);
            return new()
            {
                IsOutside = HasFrustumCulling && IsOutsideFrustum(centre, halfSize),
                ProjectedSize = IsPerspective ? maxExtent / depth : maxExtent,
                Right = -1,
            };
        }

        var (maxInverseDepth, minInverseDepth) = IsPerspective ? (1 / zLow, 1 / zHigh) : (1.0, 1.0);
        var left = CentreX + (ScaleX * low[0] * (low[0] < 0 ? maxInverseDepth : minInverseDepth));
        var right = CentreX + (ScaleX * high[0] * (high[0] > 0 ? maxInverseDepth : minInverseDepth));
        var top = CentreY - (ScaleY * high[1] * (high[1] > 0 ? maxInverseDepth : minInverseDepth));
        var bottom = CentreY - (ScaleY * low[1] * (low[1] < 0 ? maxInverseDepth : minInverseDepth));
        var inverseDepth = IsPerspective ? maxInverseDepth : -zLow;
        return ClipRectangle((float)left, (float)right, (float)top, (float)bottom, (float)inverseDepth);
    }

    /// <summary>Clips a rectangle of the frame to the strip, and rounds it to samples.</summary>
    /// <param name="left">Left edge, pixels.</param>
    /// <param name="right">Right edge.</param>
    /// <param name="top">Upper edge.</param>
    /// <param name="bottom">Lower edge.</param>
    /// <param name="inverseDepth">Largest inverse depth of what the rectangle holds.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public ScreenFootprint ClipRectangle(float left, float right, float top, float bottom, float inverseDepth)
    {
        if (HasFrustumCulling && !(right >= Left && left <= Right && bottom >= 0 && top <= Height))
        {
            return ScreenFootprint.Outside;
        }

        // The pixels whose samples may lie between the edges.
        var firstX = MathF.Ceiling(left - _maxSampleOffset);
        var lastX = MathF.Floor(right - _minSampleOffset);
        var firstY = MathF.Ceiling(top - _maxSampleOffset);
        var lastY = MathF.Floor(bottom - _minSampleOffset);
        return new()
        {
            IsBeyondNearPlane = true,
            ProjectedSize = Math.Max(right - left, bottom - top),
            MaxInverseDepth = inverseDepth,
            CoversNoSample = firstX > lastX || firstY > lastY,
            // What ends on the border is found on both sides.
            IsShared = !HasFrustumCulling || !(left > Left && right < Right),
            Left = (int)Math.Max(firstX, Left),
            Right = (int)Math.Min(lastX, Right - 1),
            Top = (int)Math.Max(firstY, 0),
            Bottom = (int)Math.Min(lastY, Height - 1),
        };
    }

    /// <summary>Tests whether a box in view space is so far outside the frustum that every box inside it is outside too.</summary>
    /// <param name="centre">Centre of the box: x, y, z, 0.</param>
    /// <param name="halfSize">Half the size of the box, with a margin for rounding: x, y, z, 0.</param>
    public bool IsGroupOutside(Vector256<double> centre, Vector256<double> halfSize)
    {
        var zHigh = centre[2] + halfSize[2];
        if (zHigh < Near || centre[2] - halfSize[2] > Far)
        {
            return true;
        }

        // Footprints are rounded to single precision, up to the padding. It grows with the depth in perspective.
        var padding = GroupPadding * (IsPerspective ? Math.Max(0, zHigh) : 1) * Vector128.Create(1 / ScaleX, 1 / ScaleY);
        return IsOutsideFrustum(centre, halfSize + Vector256.Create(padding, Vector128<double>.Zero));
    }

    private static int SamplesPerAxis(CullingSettings settings) => settings.IsMultisampled ? MultisampleFactor : 1;

    /// <summary>Normal of the section plane in view space; zero without a section.</summary>
    private static Vector SectionNormal(in CullingView view) =>
        view.Section is { } section ? view.Axes.Inverse() * section.Normal : Vector.Zero;

    /// <summary>Tests whether a box lies beyond one of the planes through the eye and the edges of the strip.</summary>
    private bool IsOutsideFrustum(Vector256<double> centre, Vector256<double> halfSize)
    {
        var inverseScaleX = 1 / ScaleX;
        var inverseScaleY = 1 / ScaleY;
        var left = (Left - CentreX) * inverseScaleX;
        var right = (Right - CentreX) * inverseScaleX;
        var top = CentreY * inverseScaleY;
        var bottom = (CentreY - Height) * inverseScaleY;
        return IsBoxBeyondPlane(-1, left, centre[0], halfSize[0], centre[2], halfSize[2])
            || IsBoxBeyondPlane(1, -right, centre[0], halfSize[0], centre[2], halfSize[2])
            || IsBoxBeyondPlane(1, -top, centre[1], halfSize[1], centre[2], halfSize[2])
            || IsBoxBeyondPlane(-1, bottom, centre[1], halfSize[1], centre[2], halfSize[2]);
    }

    /// <summary>Tests whether sign · x + slope · z (in perspective, else sign · x + slope) is positive in the whole box.</summary>
    private bool IsBoxBeyondPlane(double sign, double slope, double x, double halfX, double z, double halfZ) => IsPerspective
        ? (sign * x) + (slope * z) - halfX - (Math.Abs(slope) * halfZ) > 0
        : (sign * x) + slope - halfX > 0;
}
