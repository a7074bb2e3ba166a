using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <content>The search on the image of the faces under a map.</content>
internal sealed partial class FaceHierarchy
{
    /// <summary>The same on the image of the faces under any map, one level after another in double precision.</summary>
    /// <param name="position">In the frame of the image.</param>
    /// <param name="map">To that frame.</param>
    /// <param name="nearestSquared">As in <see cref="Search"/>.</param>
    /// <param name="nearestFace">As in <see cref="Search"/>.</param>
    /// <param name="boundFactor">As in <see cref="Search"/>.</param>
    /// <param name="faceTests">Increased by the faces looked at.</param>
    /// <param name="boundTests">Increased by the bounds looked at.</param>
    public void SearchImage(
        Vector position, in AffineMap map, ref double nearestSquared, ref int nearestFace, double boundFactor, ref long faceTests, ref long boundTests)
    {
        if (_mesh.FaceCount <= FacesWithoutBoxes)
        {
            LookAtAllImages(position, in map, ref nearestSquared, ref nearestFace, ref faceTests);
            return;
        }

        var state = new Query(position, Vector.Zero, nearestSquared, nearestFace);
        SearchImage(ref state, 0, in map, boundFactor);
        (nearestSquared, nearestFace) = (state.NearestSquared, state.NearestFace);
        faceTests += state.FaceTests;
        boundTests += state.BoundTests;
    }

    private void SearchImage(ref Query query, int node, in AffineMap map, double boundFactor)
    {
        var boxes = _boxes.AsSpan(node * HierarchyLayout.NodeVectors, HierarchyLayout.NodeVectors);
        var perUnit = 1 / _scale;
        var offset = VectorQuartet.All(query.Position - (map * _origin));
        var (v1, v2, v3) = (VectorQuartet.All(perUnit * map.Linear.V1), VectorQuartet.All(perUnit * map.Linear.V2), VectorQuartet.All(perUnit * map.Linear.V3));
        Span<double> bounds = stackalloc double[FaceHierarchyBuilder.Width];
        var half = Vector256.Create(0.5);
        for (var part = 0; part < 2; part++)
        {
            VectorQuartet minimum = new(Half(boxes[0], part), Half(boxes[1], part), Half(boxes[2], part));
            VectorQuartet maximum = new(Half(boxes[3], part), Half(boxes[4], part), Half(boxes[5], part));
            var centre = half * (minimum + maximum);
            var away = offset - ((centre.X * v1) + (centre.Y * v2) + (centre.Z * v3));
            ImageDistances.Beyond(away, half * (maximum - minimum), v1, v2, v3).CopyTo(bounds[(4 * part)..]);
        }

        query.BoundTests += FaceHierarchyBuilder.Width;
        while (true)
        {
            var (nearest, smallest) = (-1, double.PositiveInfinity);
            for (var child = 0; child < bounds.Length; child++)
            {
                // False for NaN, which children have that are not there.
                (nearest, smallest) = bounds[child] < smallest ? (child, bounds[child]) : (nearest, smallest);
            }

            // Boxes are wider than their faces by more than rounding.
            if (nearest < 0 || !(smallest * boundFactor < query.NearestSquared))
            {
                return;
            }

            bounds[nearest] = double.PositiveInfinity;
            var next = _children[(node * FaceHierarchyBuilder.Width) + nearest];
            if (next >= 0)
            {
                SearchImage(ref query, next, in map, boundFactor);
                continue;
            }

            var number = (uint)~next;
            var leaf = (int)(number / FaceHierarchyBuilder.LeafFaces);
            query.FaceTests += (number % FaceHierarchyBuilder.LeafFaces) + 1;
            Look(ImageSquaredDistances(leaf, in query.Position, in map), leaf, ref query.NearestSquared, ref query.NearestFace);
        }
    }

    private static Vector256<double> Half(Vector256<float> lanes, int part) =>
        part == 0 ? Vector256.WidenLower(lanes) : Vector256.WidenUpper(lanes);

    /// <summary>Looks at the image of every face.</summary>
    /// <param name="position">In the frame of the images.</param>
    /// <param name="map">To that frame.</param>
    /// <param name="nearestSquared">As in <see cref="Search"/>.</param>
    /// <param name="nearestFace">As in <see cref="Search"/>.</param>
    /// <param name="faceTests">Increased by the faces of the mesh.</param>
    public void LookAtAllImages(Vector position, in AffineMap map, ref double nearestSquared, ref int nearestFace, ref long faceTests)
    {
        for (var leaf = 0; leaf < _leaves.Length; leaf++)
        {
            Look(ImageSquaredDistances(leaf, in position, in map), leaf, ref nearestSquared, ref nearestFace);
        }

        faceTests += _mesh.FaceCount;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Vector256<double> ImageSquaredDistances(int leaf, ref readonly Vector position, ref readonly AffineMap map) =>
        FaceQuartet.SquaredDistances(in _leaves[leaf], _mesh.Positions.AsSpan(), in position, in map);
}
