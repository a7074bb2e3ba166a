using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;

namespace FractalEngine.Tests.Visibility;

/// <summary>
/// The nearest surface at the middle of each pixel, in double precision: every face of every instance, cut at the near and the far plane.
/// </summary>
internal sealed class DepthImage
{
    private readonly CullingView _view;
    private readonly bool _hasSamples;
    private readonly double[] _depth;
    private readonly double[] _projected = new double[3 * 4];

    /// <summary>Without any surface.</summary>
    /// <param name="view">How it is looked at.</param>
    /// <param name="hasSamples">
    /// True for four samples a pixel, where graphics hardware has them: the picture then has twice the size.
    /// </param>
    public DepthImage(CullingView view, bool hasSamples = false)
    {
        view = hasSamples ? view with { Width = 2 * view.Width, Height = 2 * view.Height } : view;
        _hasSamples = hasSamples;
        (_view, _depth, ClosestInstance) = (view, new double[view.Width * view.Height], new int[view.Width * view.Height]);
        Array.Fill(_depth, double.PositiveInfinity);
        Array.Fill(ClosestInstance, -1);
    }

    /// <summary>Which instance is nearest, −1 for none, [height × width].</summary>
    public int[] ClosestInstance { get; }

    /// <summary>Of the nearest; infinite where there is none.</summary>
    public ReadOnlySpan<double> Depth => _depth;

    /// <summary>Draws a mesh; the map leads to world axes about the camera.</summary>
    public void Draw(Mesh mesh, AffineMap map, int number)
    {
        var inverse = _view.Axes.Inverse();
        var corners = new Vector[mesh.VertexCount];
        for (var i = 0; i < corners.Length; i++)
        {
            corners[i] = inverse * (map * mesh.Vertex(i));
        }

        for (var i = 0; i < mesh.VertexIndices.Length; i += 3)
        {
            ClipToNearPlane(corners[mesh.VertexIndices[i]], corners[mesh.VertexIndices[i + 1]], corners[mesh.VertexIndices[i + 2]], number);
        }
    }

    /// <summary>Where a point in view space appears: pixels from the upper left.</summary>
    public static (double X, double Y) Project(in CullingView view, Vector point)
    {
        var perspectiveScale = view.IsPerspective ? 1 / point.Z : 1;
        return ((0.5 * view.Width) + (view.PixelsPerUnitX * point.X * perspectiveScale),
            (0.5 * view.Height) - (view.PixelsPerUnitY * point.Y * perspectiveScale));
    }

    private void ClipToNearPlane(Vector a, Vector b, Vector c, int number)
    {
        // At the near plane: none, one or two triangles are left.
        Vector[] corners = [a, b, c];
        var clipped = new List<Vector>(4);
        for (var i = 0; i < 3; i++)
        {
            var (from, to) = (corners[i], corners[(i + 1) % 3]);
            if (from.Z >= _view.Near)
            {
                clipped.Add(from);
            }

            if (from.Z >= _view.Near != to.Z >= _view.Near)
            {
                var t = (_view.Near - from.Z) / (to.Z - from.Z);
                var point = from + (t * (to - from));
                clipped.Add(new(point.X, point.Y, _view.Near));
            }
        }

        for (var i = 2; i < clipped.Count; i++)
        {
            Rasterize(clipped[0], clipped[i - 1], clipped[i], number);
        }
    }

    private void Rasterize(Vector a, Vector b, Vector c, int number)
    {
        StoreProjected(a, 0);
        StoreProjected(b, 1);
        StoreProjected(c, 2);
        var (ax, ay, an) = (_projected[0], _projected[1], _projected[2]);
        var (bx, by, bn) = (_projected[3], _projected[4], _projected[5]);
        var (cx, cy, cn) = (_projected[6], _projected[7], _projected[8]);
        var area = ((bx - ax) * (cy - ay)) - ((by - ay) * (cx - ax));
        if (area == 0)
        {
            return;
        }

        var left = (int)Math.Max(0, Math.Ceiling(Math.Min(ax, Math.Min(bx, cx)) - 0.75));
        var right = (int)Math.Min(_view.Width - 1, Math.Floor(Math.Max(ax, Math.Max(bx, cx)) - 0.25));
        var top = (int)Math.Max(0, Math.Ceiling(Math.Min(ay, Math.Min(by, cy)) - 0.75));
        var bottom = (int)Math.Min(_view.Height - 1, Math.Floor(Math.Max(ay, Math.Max(by, cy)) - 0.25));
        for (var y = top; y <= bottom; y++)
        {
            for (var x = left; x <= right; x++)
            {
                // The standard pattern, y downwards: (3, 7), (7, 5), (1, 3), (5, 1) eighths of a pixel.
                var (offsetX, offsetY) = !_hasSamples ? (0.5, 0.5) : (y % 2 == 0 ? 0.25 : 0.75, x % 2 == 0 ? 0.75 : 0.25);
                var (px, py) = (x + offsetX - ax, y + offsetY - ay);
                var (weightB, weightC) = (((px * (cy - ay)) - (py * (cx - ax))) / area, ((py * (bx - ax)) - (px * (by - ay))) / area);
                if (weightB < 0 || weightC < 0 || weightB + weightC > 1)
                {
                    continue;
                }

                var inverseDepth = an + (weightB * (bn - an)) + (weightC * (cn - an));
                var depth = _view.IsPerspective ? 1 / inverseDepth : -inverseDepth;
                var index = (y * _view.Width) + x;
                if (depth < _depth[index] && depth <= _view.Far)
                {
                    (_depth[index], ClosestInstance[index]) = (depth, number);
                }
            }
        }
    }

    private void StoreProjected(Vector point, int index)
    {
        var (x, y) = Project(in _view, point);
        (_projected[3 * index], _projected[(3 * index) + 1], _projected[(3 * index) + 2]) =
            (x, y, _view.IsPerspective ? 1 / point.Z : -point.Z);
    }
}
