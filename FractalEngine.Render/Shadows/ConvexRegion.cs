using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Shadows;

/// <summary>The part of space that a view shows of a box: the corners of the intersection of two hexahedra.</summary>
/// <remarks>Memory is reused: filling a region again allocates nothing.</remarks>
internal sealed class ConvexRegion
{
    // The corners of the six faces of a hexahedron whose corner i has the signs of the bits of i, each around its face.
    private static readonly int[][] Faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];

    private readonly Vector[] _frustum = new Vector[8];
    private readonly Vector[] _box = new Vector[8];
    private readonly List<Vector> _corners = [];
    private List<Vector> _polygon = [];
    private List<Vector> _clipped = [];

    /// <summary>Corners of the region; some may stand more than once.</summary>
    public ReadOnlySpan<Vector> Corners => CollectionsMarshal.AsSpan(_corners);

    /// <summary>Makes the region a whole box.</summary>
    public void SetBox(BoundingBox box)
    {
        _corners.Clear();
        FillBox(box);
        _corners.AddRange(_box);
    }

    /// <summary>Makes the region the part of a box that a slice of a view shows.</summary>
    /// <param name="position">Position of the camera.</param>
    /// <param name="axes">Columns are the camera's axes.</param>
    /// <param name="isPerspective">Whether the view is a perspective one.</param>
    /// <param name="halfWidth">Half the width of the view: at depth 1 in perspective.</param>
    /// <param name="halfHeight">Half the height, likewise.</param>
    /// <param name="near">Depth at which the slice begins.</param>
    /// <param name="far">Depth at which it ends.</param>
    /// <param name="box">Box, not empty, finite.</param>
    public void SetSlice(
        Vector position, Matrix axes, bool isPerspective, double halfWidth, double halfHeight, double near, double far, BoundingBox box)
    {
        _corners.Clear();
        FillBox(box);
        for (var i = 0; i < 8; i++)
        {
            var depth = (i & 4) == 0 ? near : far;
            var scale = isPerspective ? depth : 1;
            var (x, y) = ((i & 1) == 0 ? -halfWidth : halfWidth, (i & 2) == 0 ? -halfHeight : halfHeight);
            _frustum[i] = position + (axes * new Vector(x * scale, y * scale, depth));
        }

        // Each corner of the intersection lies on a face of one of the two, within the other.
        AddClippedFaces(_frustum, _box);
        AddClippedFaces(_box, _frustum);
    }

    private void FillBox(BoundingBox box)
    {
        for (var i = 0; i < 8; i++)
        {
            _box[i] = box.Corner(i);
        }
    }

    private void AddClippedFaces(Vector[] clipped, Vector[] clipping)
    {
        var centre = Vector.Zero;
        foreach (var corner in clipping)
        {
            centre += corner / 8;
        }

        foreach (var face in Faces)
        {
            _polygon.Clear();
            foreach (var corner in face)
            {
                _polygon.Add(clipped[corner]);
            }

            foreach (var other in Faces)
            {
                // Diagonals span the plane even where the face is flat on one side, as that of a near plane at the eye.
                var normal = Vector.Cross(clipping[other[2]] - clipping[other[0]], clipping[other[3]] - clipping[other[1]]);
                var origin = clipping[other[0]];
                ClipToPlane(Vector.Dot(normal, centre - origin) < 0 ? -normal : normal, origin);
            }

            _corners.AddRange(_polygon);
        }
    }

    /// <summary>Keeps the part of the polygon on the side of a plane that its normal points to.</summary>
    private void ClipToPlane(Vector normal, Vector origin)
    {
        _clipped.Clear();
        for (var i = 0; i < _polygon.Count; i++)
        {
            var a = _polygon[i];
            var b = _polygon[(i + 1) % _polygon.Count];
            var heightA = Vector.Dot(normal, a - origin);
            var heightB = Vector.Dot(normal, b - origin);
            if (heightA >= 0)
            {
                _clipped.Add(a);
            }

            if (heightA >= 0 != heightB >= 0)
            {
                _clipped.Add(a + (heightA / (heightA - heightB) * (b - a)));
            }
        }

        (_polygon, _clipped) = (_clipped, _polygon);
    }
}
