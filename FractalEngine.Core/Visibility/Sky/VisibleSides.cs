using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Sky;

/// <summary>Tells which of the six sides of a base mesh an eye sees at all: of a cube, three at most.</summary>
internal sealed class VisibleSides
{
    /// <summary>The bits of all six sides of an instance, seen or not.</summary>
    public const int All = (1 << AmbientCube.Count) - 1;

    // Meshes with more planes, such as balls, show nearly all of their sides.
    private const int MaxPlanes = 12;

    // By the size of what is added up: far more than the rounding of single precision moves an edge-on face.
    private const double Margin = 1e-4;

    // Planes of the faces, as windings have them: normal, and minus the distance. Without any, all sides count as seen.
    private readonly Vector256<double>[] _planes;
    private readonly int[] _frontSides;
    private readonly int[] _backSides;
    private readonly Vector _centre;

    /// <summary>Collects the planes of a mesh, unless its shading has normals of its own.</summary>
    public VisibleSides(Mesh mesh)
    {
        var planes = new List<Vector256<double>>();
        for (var i = 0; i < mesh.FaceCount && mesh.Normals.IsEmpty && planes.Count <= MaxPlanes; i++)
        {
            var (a, b, c) = mesh.Face(i);
            var normal = Vector.Cross(b - a, c - a);
            normal /= Math.Max(normal.Length(), double.Epsilon);
            var plane = Vector256.Create(normal.X, normal.Y, normal.Z, -Vector.Dot(normal, a));
            if (!planes.Exists(other => IsClose(other, plane)))
            {
                planes.Add(plane);
            }
        }

        _centre = mesh.FaceCount > 0 ? mesh.Bounds.Centre : Vector.Zero;
        _planes = planes.Count <= MaxPlanes ? [.. planes] : [];
        _frontSides = [.. _planes.Select(static plane => SidesOf(SimdAffineMap.ToVector(plane)))];
        _backSides = [.. _planes.Select(static plane => SidesOf(-SimdAffineMap.ToVector(plane)))];

        bool IsClose(Vector256<double> plane1, Vector256<double> plane2)
        {
            var difference = Vector256.Abs(plane1 - plane2);
            return difference[0] + difference[1] + difference[2] < 1e-9 && difference[3] < 1e-9 * mesh.Bounds.Diagonal;
        }
    }

    /// <summary>Finds the sides that faces have which are seen, of an open surface on the side of the eye: bit i for side i.</summary>
    /// <param name="meshToView">Map to view space, whose eye is the origin and looks along z.</param>
    /// <param name="isPerspective">False where all rays are parallel to z.</param>
    /// <param name="isMirroredView">Whether the map from view space to world space changes the handedness.</param>
    /// <param name="windingSign">
    /// 1 where the mesh is a closed solid wound outwards, −1 inwards, so that only the outer sides of its faces are seen; otherwise 0.
    /// </param>
    public int FindVisible(in SimdAffineMap meshToView, bool isPerspective, bool isMirroredView, int windingSign)
    {
        // In mirrored frames, front faces are back faces. These are rare, and flat frames have no inverse.
        if (_planes.Length == 0 || FindEye(in meshToView, isPerspective, out var determinant) is var eye
            && !(isMirroredView ? determinant < 0 : determinant > 0))
        {
            return All;
        }

        var size = Margin * Vector256.Abs(eye);
        var sides = 0;
        for (var i = 0; i < _planes.Length; i++)
        {
            var height = Vector256.Dot(_planes[i], eye);
            var margin = Vector256.Dot(Vector256.Abs(_planes[i]), size);
            sides |= windingSign >= 0 && height > -margin ? _frontSides[i] : 0;
            sides |= windingSign <= 0 && height < margin ? _backSides[i] : 0;
        }

        return sides;
    }

    /// <summary>
    /// Finds the sides that face the eye, three at most: what an eye sees of a surface, outer or inner sides, faces mainly these.
    /// </summary>
    /// <param name="meshToView">As for <see cref="FindVisible"/>.</param>
    /// <param name="isPerspective">As for <see cref="FindVisible"/>.</param>
    public int FindFacing(in SimdAffineMap meshToView, bool isPerspective)
    {
        var eye = FindEye(in meshToView, isPerspective, out var determinant);
        if (determinant == 0)
        {
            return All;
        }

        var (x, y, z) = SimdAffineMap.ToVector(eye) - (eye[3] * _centre);
        return (x >= 0 ? 1 : 8) | (y >= 0 ? 2 : 16) | (z >= 0 ? 4 : 32);
    }

    /// <summary>Finds the eye in the frame of the mesh: homogeneous coordinates, whose last one is 0 for a direction.</summary>
    private static Vector256<double> FindEye(in SimdAffineMap meshToView, bool isPerspective, out double determinant)
    {
        var (v1, v2, v3) =
            (SimdAffineMap.ToVector(meshToView.V1), SimdAffineMap.ToVector(meshToView.V2), SimdAffineMap.ToVector(meshToView.V3));
        var normal1 = Vector.Cross(v2, v3);
        determinant = Vector.Dot(v1, normal1);
        var towardsEye = isPerspective ? -SimdAffineMap.ToVector(meshToView.Translation) : -Vector.K;
        return Math.Sign(determinant) * Vector256.Create(
            Vector.Dot(normal1, towardsEye), Vector.Dot(Vector.Cross(v3, v1), towardsEye), Vector.Dot(Vector.Cross(v1, v2), towardsEye),
            isPerspective ? determinant : 0);
    }

    private static int SidesOf(Vector normal)
    {
        var sides = 0;
        for (var side = 0; side < AmbientCube.Count; side++)
        {
            sides |= Vector.Dot(normal, AmbientCube.NormalOf(side)) > 1e-6 ? 1 << side : 0;
        }

        return sides;
    }
}
