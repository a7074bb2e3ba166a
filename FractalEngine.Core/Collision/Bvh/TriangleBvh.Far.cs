using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Bvh;

/// <content>The search far from the mesh, in double precision, and the decision between triangles.</content>
internal sealed partial class TriangleBvh
{
    private const double FarSlack = 1.0 / (1L << 40);

    /// <summary>Searches in double precision, which is slower, for positions far from the mesh.</summary>
    private void TraverseFar(
        BvhChild node, in Vector position, in Vector localPosition, ref ClosestTriangle closest, double inverseBoundFactor)
    {
        var cutoff = BoundCutoff.Create(_scale, inverseBoundFactor, FarSlack, _magnitude + localPosition.MaxAbsComponent());
        Span<double> bounds = stackalloc double[BvhLayout.BranchingFactor];
        for (var child = 0; child < bounds.Length; child++)
        {
            bounds[child] = LocalBox(node, child).DistanceSquared(localPosition);
        }

        closest.BoundTests += BvhLayout.BranchingFactor;
        while (true)
        {
            var closestChild = 0;
            for (var child = 1; child < bounds.Length; child++)
            {
                closestChild = bounds[child] < bounds[closestChild] ? child : closestChild;
            }

            if (!(bounds[closestChild] < cutoff.For(closest.DistanceSquared)))
            {
                return;
            }

            bounds[closestChild] = double.PositiveInfinity;
            var next = Children(node)[closestChild];
            if (next.IsNode)
            {
                TraverseFar(next, in position, in localPosition, ref closest, inverseBoundFactor);
            }
            else
            {
                TestLeaf(next, in position, ref closest);
            }
        }
    }

    private void TestLeaf(BvhChild leaf, in Vector position, ref ClosestTriangle closest)
    {
        closest.FaceTests += leaf.TriangleCount;
        if (_precomputed is not null)
        {
            _precomputed.Test(_precomputed.QuadOf(leaf), in position, ref closest);
        }
        else
        {
            TestFaces(_faces.AsSpan(leaf.FirstTriangle, leaf.TriangleCount), in position, ref closest);
        }
    }

    /// <summary>Tests some triangles in double precision, four at a time.</summary>
    private void TestFaces(ReadOnlySpan<int> faces, in Vector position, ref ClosestTriangle closest)
    {
        for (; faces.Length > 0; faces = faces[Math.Min(VectorX4.Count, faces.Length)..])
        {
            var quad = faces[..Math.Min(VectorX4.Count, faces.Length)];
            closest.Update(TriangleX4.DistancesSquared(_mesh, quad, in position), quad);
        }
    }

    /// <summary>Finds the closest of some candidates in double precision.</summary>
    private void Decide(ref readonly CandidateList candidates, in Vector position, ref ClosestTriangle closest)
    {
        Span<int> faces = stackalloc int[CandidateList.Capacity];
        for (var i = 0; i < candidates.Count; i++)
        {
            faces[i] = _faces[candidates[i]];
        }

        TestFaces(faces[..candidates.Count], in position, ref closest);
    }
}
