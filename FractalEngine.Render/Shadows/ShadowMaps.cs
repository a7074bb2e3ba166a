using FractalEngine.Core.Geometry;
using FractalEngine.Core.Visibility.Frames;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Views;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Shadows;

/// <summary>
/// The depth maps of all lights in one texture. Those of what stands are kept until something about them changes; what moves is drawn into
/// a copy, of which only the places are restored where something moved.
/// </summary>
internal sealed class ShadowMaps(GlResources resources) : IDisposable
{
    // Number of depths in 16 bits, and the largest step between two of them, texels. Surfaces are compared 1.3 texels towards the light.
    private const int CoarseDepths = 65536;
    private const double MaxCoarseStep = 0.125;

    private readonly List<ShadowView> _drawnViews = [];
    private readonly List<(int X, int Y)> _corners = [];
    private readonly List<(int Left, int Bottom, int Right, int Top)> _dirtyRectangles = [];
    private DepthAtlas? _standing;
    private DepthAtlas? _complete;
    private (CullingSettings? Culling, DeepZoom? Zoom, long Version)? _lastKey;
    private bool _isCopyStale = true;
    private long _lastMovingVersion;

    /// <summary>Corner of each view's map in the texture.</summary>
    public IReadOnlyList<(int X, int Y)> Corners => _corners;

    /// <summary>Width and height of the texture, texels; 1 while there is none.</summary>
    public (int Width, int Height) TextureSize => _standing is null ? (1, 1) : (_standing.Width, _standing.Height);

    /// <summary>Number of maps that the last update drew.</summary>
    public int DrawnCount { get; private set; }

    /// <summary>Draws the maps of what stands, where their view or the content has changed.</summary>
    /// <param name="views">Views of all maps.</param>
    /// <param name="culling">Settings of culling.</param>
    /// <param name="zoom">Deep zoom of the frame.</param>
    /// <param name="version">Changes when something that stands was moved.</param>
    /// <param name="isKept">False to draw all maps anew.</param>
    /// <param name="draw">Draws one view.</param>
    public void DrawStanding(
        List<ShadowView> views, CullingSettings? culling, DeepZoom? zoom, long version, bool isKept, Action<ShadowView> draw)
    {
        DrawnCount = 0;
        var isCurrent = isKept && _standing is not null && _lastKey == (culling, zoom, version) && HasSameSizes(views);
        if (!isCurrent)
        {
            _drawnViews.Clear();
            var (width, height) = AtlasLayout.Place(views, _corners);
            var isFine = NeedsFineDepths(views);
            if (_standing is null || (_standing.Width, _standing.Height, _standing.IsFine) != (width, height, isFine))
            {
                _standing?.Dispose();
                _complete?.Dispose();
                _complete = null;
                _standing = null;
                _standing = new(resources, "shadow maps", width, height, isFine);
            }
        }

        _lastKey = null;
        for (var i = 0; i < views.Count; i++)
        {
            if (i < _drawnViews.Count && _drawnViews[i] == views[i])
            {
                continue;
            }

            _standing!.Bind();
            SelectMap(i, views[i], clears: true);
            draw(views[i]);
            DrawnCount++;
        }

        if (DrawnCount > 0)
        {
            _isCopyStale = true;
            _drawnViews.Clear();
            _drawnViews.AddRange(views);
        }

        _lastKey = (culling, zoom, version);
    }

    /// <summary>Copies the maps, to draw what moves into the copy.</summary>
    /// <param name="version">Changes when something that moves has moved.</param>
    /// <returns>False where the copy is up to date.</returns>
    public bool TryBeginMoving(long version)
    {
        if (!_isCopyStale && _complete is not null && _lastMovingVersion == version)
        {
            return false;
        }

        _lastMovingVersion = version;
        if (_complete is null)
        {
            _complete = new(resources, "shadow maps with bodies", _standing!.Width, _standing.Height, _standing.IsFine);
            _isCopyStale = true;
        }

        if (_isCopyStale)
        {
            _standing!.CopyTo(_complete, 0, 0, _complete.Width, _complete.Height);
        }
        else
        {
            foreach (var (left, bottom, right, top) in _dirtyRectangles)
            {
                _standing!.CopyTo(_complete, left, bottom, right, top);
            }
        }

        _isCopyStale = false;
        _dirtyRectangles.Clear();
        _complete.Bind();
        return true;
    }

    /// <summary>Tells whether a view shows any of a box, and notes where, to restore that for the next frame.</summary>
    public bool TryMark(int index, in ShadowView view, BoundingBox box)
    {
        var toView = view.Axes.Transpose();
        var centre = toView * (box.Centre - view.Position);
        var halfSize = toView.Absolute() * (0.5 * box.Size);
        // Parallel light comes from beyond all bodies, also those that have left the scene's bounds.
        if (!((!view.IsPerspective || centre.Z + halfSize.Z > view.CasterNear) && centre.Z - halfSize.Z < view.Far))
        {
            return false;
        }

        var (x, y) = _corners[index];
        var (left, right, bottom, top) = (-1.0, 1.0, -1.0, 1.0);
        var depth = centre.Z - halfSize.Z;
        if (!view.IsPerspective || depth > view.Near)
        {
            // In perspective the nearest and the farthest depth bound the rectangle.
            var (near, far) = view.IsPerspective ? (1 / depth, 1 / (centre.Z + halfSize.Z)) : (1, 1);
            left = Math.Max(left, Math.Min((centre.X - halfSize.X) * near, (centre.X - halfSize.X) * far) / view.HalfWidth);
            right = Math.Min(right, Math.Max((centre.X + halfSize.X) * near, (centre.X + halfSize.X) * far) / view.HalfWidth);
            bottom = Math.Max(bottom, Math.Min((centre.Y - halfSize.Y) * near, (centre.Y - halfSize.Y) * far) / view.HalfHeight);
            top = Math.Min(top, Math.Max((centre.Y + halfSize.Y) * near, (centre.Y + halfSize.Y) * far) / view.HalfHeight);
        }

        if (!(left < right && bottom < top))
        {
            return false;
        }

        var half = 0.5 * view.Size;
        _dirtyRectangles.Add((
            x + Math.Max(0, (int)(half * (1 + left)) - 1), y + Math.Max(0, (int)(half * (1 + bottom)) - 1),
            x + Math.Min(view.Size, (int)(half * (1 + right)) + 2), y + Math.Min(view.Size, (int)(half * (1 + top)) + 2)));
        return true;
    }

    /// <summary>Binds the maps to a texture unit.</summary>
    /// <param name="unit">Unit other than the first.</param>
    /// <param name="withMoving">Whether those with what moves.</param>
    public void BindTexture(int unit, bool withMoving) => (withMoving ? _complete : _standing)!.BindTexture(unit);

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_standing, _complete);

    /// <summary>Tells whether 16 bits are too few for the depths of any view: parallel ones have even steps.</summary>
    private static bool NeedsFineDepths(List<ShadowView> views) => views.Exists(
        static view => view.IsPerspective || view.Far - view.Near > MaxCoarseStep * CoarseDepths * view.TexelSize);

    private bool HasSameSizes(List<ShadowView> views)
    {
        if (views.Count != _drawnViews.Count)
        {
            return false;
        }

        for (var i = 0; i < views.Count; i++)
        {
            if (views[i].Size != _drawnViews[i].Size)
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Selects the map of a view, to draw into it.</summary>
    /// <param name="index">Index of the view.</param>
    /// <param name="view">The view.</param>
    /// <param name="clears">Whether what it shows is removed first.</param>
    public void SelectMap(int index, in ShadowView view, bool clears = false)
    {
        var (x, y) = _corners[index];
        GL.Viewport(x, y, view.Size, view.Size);
        if (view.IsPerspective)
        {
            GL.Disable(EnableCap.DepthClamp);
        }
        else
        {
            GL.Enable(EnableCap.DepthClamp);
        }

        if (clears)
        {
            GL.Enable(EnableCap.ScissorTest);
            GL.Scissor(x, y, view.Size, view.Size);
            GL.ClearDepth(0.0);
            GL.Clear(ClearBufferMask.DepthBufferBit);
            GL.Disable(EnableCap.ScissorTest);
        }
    }
}
