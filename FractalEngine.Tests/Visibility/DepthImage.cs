using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Frames;

namespace FractalEngine.Tests.Visibility;

/// <summary>
/// The depth of the closest surface at each sample of a frame, in double precision: the oracle of culling.
/// </summary>
/// <remarks>Every face of every instance is rasterized, clipped at the near plane and hidden beyond the far plane.</remarks>
internal sealed class DepthImage
{
    private readonly CullingView _view;
    private readonly bool _isMultisampled;
    private readonly double[] _depths;

    /// <summary>Creates an image without any surface.</summary>
    /// <param name="view">Camera and frame.</param>
    /// <param name="isMultisampled">
    /// True for four samples a pixel, where graphics hardware has them: the image then has twice the size.
    /// </param>
    public DepthImage(CullingView view, bool isMultisampled = false)
    {
        _view = isMultisampled ? view with { Width = 2 * view.Width, Height = 2 * view.Height } : view;
        _isMultisampled = isMultisampled;
        _depths = new double[_view.Width * _view.Height];
        ClosestInstances = new int[_view.Width * _view.Height];
        Array.Fill(_depths, double.PositiveInfinity);
        Array.Fill(ClosestInstances, -1);
    }

    /// <summary>Number of the closest instance at each sample, −1 for none, [height × width].</summary>
    public int[] ClosestInstances { get; }

    /// <summary>Depth of the closest surface at each sample, infinite for none, [height × width].</summary>
    public ReadOnlySpan<double> Depths => _depths;

    /// <summary>Draws an instance of a mesh.</summary>
    /// <param name="mesh">Mesh of the instance.</param>
    /// <param name="map">Map from the mesh's frame to world axes about the camera.</param>
    /// <param name="number">Number of the instance.</param>
    public void Draw(Mesh mesh, AffineMap map, int number)
    {
        var worldToView = _view.Axes.Inverse();
        var vertices = new Vector[mesh.VertexCount];
        for (var i = 0; i < vertices.Length; i++)
        {
            vertices[i] = worldToView * (map * mesh.Vertex(i));
        }

        var indices = mesh.VertexIndices;
        for (var i = 0; i < indices.Length; i += 3)
        {
            DrawClipped(vertices[indices[i]], vertices[indices[i + 1]], vertices[indices[i + 2]], number);
        }
    }

    /// <summary>Projects a point in view space to pixels from the upper left corner.</summary>
    public static (double X, double Y) Project(in CullingView view, Vector point)
    {
        var perspectiveScale = view.IsPerspective ? 1 / point.Z : 1;
        return ((0.5 * view.Width) + (view.PixelsPerUnitX * point.X * perspectiveScale),
            (0.5 * view.Height) - (view.PixelsPerUnitY * point.Y * perspectiveScale));
    }

    private void DrawClipped(Vector a, Vector b, Vector c, int number)
    {
        // Clipping at the near plane leaves no, one or two triangles.
        Vector[] corners = [a, b, c];
        var clipped = new List<Vector>(4);
        for (var i = 0; i < 3; i++)
        {
            var from = corners[i];
            var to = corners[(i + 1) % 3];
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
        var (ax, ay, an) = ProjectWithDepth(a);
        var (bx, by, bn) = ProjectWithDepth(b);
        var (cx, cy, cn) = ProjectWithDepth(c);
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
                var offsetX = !_isMultisampled ? 0.5 : y % 2 == 0 ? 0.25 : 0.75;
                var offsetY = !_isMultisampled ? 0.5 : x % 2 == 0 ? 0.75 : 0.25;
                var (px, py) = (x + offsetX - ax, y + offsetY - ay);
                var weightB = ((px * (cy - ay)) - (py * (cx - ax))) / area;
                var weightC = ((py * (bx - ax)) - (px * (by - ay))) / area;
                if (weightB < 0 || weightC < 0 || weightB + weightC > 1)
                {
                    continue;
                }

                var inverseDepth = an + (weightB * (bn - an)) + (weightC * (cn - an));
                var depth = _view.IsPerspective ? 1 / inverseDepth : -inverseDepth;
                var index = (y * _view.Width) + x;
                if (depth < _depths[index] && depth <= _view.Far)
                {
                    _depths[index] = depth;
                    ClosestInstances[index] = number;
                }
            }
        }
    }

    /// <summary>Projects a point to pixels and an inverse depth, which is linear on the screen.</summary>
    private (double X, double Y, double InverseDepth) ProjectWithDepth(Vector point)
    {
        var (x, y) = Project(in _view, point);
        return (x, y, _view.IsPerspective ? 1 / point.Z : -point.Z);
    }
}
