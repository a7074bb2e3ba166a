using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// The faces of a mesh, arranged for finding the nearest one: a tree of boxes, eight children a node, up to four faces a leaf. Exact;
/// the distance that it finds is to the last bit the smallest that <see cref="FaceKernel"/> gives for any of the faces.
/// </summary>
/// <remarks>
/// Boxes are floats relative to the mesh's centre and size, rounded outwards, and a position becomes an interval of floats that holds
/// it, so that a box's distance comes out too large by no more than the rounding of four sums and three products. The limit that it is
/// compared with is raised by more than that and by more than the rounding of the kernel (see <see cref="Limit"/>): no box is passed over whose faces
/// could be nearer. Positions so far away that an interval of floats would hold all boxes are compared in double precision.
/// <para>Faces are looked at in double precision, four at once, where the mesh has them; meshes of up to 64 faces keep what they can in advance.</para>
/// </remarks>
internal sealed partial class FaceHierarchy
{
    // Up to here faces are kept as quartets, 136 bytes each; up to the second number they are all looked at without asking for boxes.
    private const int FewFaces = 64;
    private const int FacesWithoutBoxes = 8;

    // In units of the mesh's half size. Here the rounding of a position to single precision is 4e-6 of it, less than most faces.
    private const double FarAway = 64;

    private const double Rounding = 1.0 / (1L << 46);
    private const double NearSlack = 1.0 / (1L << 20);
    private const double FarSlack = 1.0 / (1L << 40);

    private readonly Mesh _mesh;
    private readonly Vector _origin;
    private readonly double _scale;
    private readonly double _magnitude;
    private readonly Vector256<float>[] _boxes = [];
    private readonly int[] _children = [];
    private readonly HierarchyLeaf[] _leaves = [];
    private readonly FaceQuartet[] _quartets = [];
    private readonly int _stackSize;

    /// <summary>Arranges the faces of a mesh. Cost: O(n·log n), on all cores where there are many faces.</summary>
    public FaceHierarchy(Mesh mesh)
    {
        _mesh = mesh;
        if (mesh.FaceCount == 0)
        {
            return;
        }

        _origin = mesh.Bounds.Centre;
        _scale = PowerOfTwoBelow(0.5 * mesh.Bounds.Size.MaximumComponent());
        var largest = Vector.Max(mesh.Bounds.Minimum.Absolute(), mesh.Bounds.Maximum.Absolute()).MaximumComponent();
        _magnitude = (2 * largest * _scale) + FarAway;
        var layout = FaceHierarchyBuilder.Build(mesh, _origin, _scale);
        _boxes = [.. layout.Boxes];
        _children = [.. layout.Children];
        _leaves = [.. layout.Leaves];
        _quartets = mesh.FaceCount <= FewFaces ? [.. layout.Leaves.Select(Quartet)] : [];
        // A node on the stack gives way to up to eight.
        _stackSize = ((FaceHierarchyBuilder.Width - 1) * Depth(0)) + 1;
    }

    /// <summary>Of the mesh.</summary>
    public int FaceCount => _mesh.FaceCount;

    /// <summary>Bytes kept beside the mesh.</summary>
    public long StorageBytes => (_boxes.Length * 32L) + (_children.Length * 4L) + (_leaves.Length * 64L) + (_quartets.Length * (long)Unsafe.SizeOf<FaceQuartet>());

    /// <summary>Looks for a face nearer than the nearest so far.</summary>
    /// <param name="position">In the mesh's frame.</param>
    /// <param name="nearestSquared">Squared distance of the nearest so far, exclusive; lowered when a nearer face is found.</param>
    /// <param name="nearestFace">Set when a nearer face is found.</param>
    /// <param name="boundFactor">Bounds are multiplied by this before they are compared: (1 + ε)², 1 for exact answers.</param>
    /// <param name="faceTests">Increased by the faces looked at.</param>
    /// <param name="boundTests">Increased by the bounds looked at.</param>
    public void Search(
        Vector position, ref double nearestSquared, ref int nearestFace, double boundFactor, ref long faceTests, ref long boundTests)
    {
        if (_mesh.FaceCount <= FacesWithoutBoxes)
        {
            LookAtAll(position, ref nearestSquared, ref nearestFace, ref faceTests);
            return;
        }

        var local = (position - _origin) * _scale;
        var state = new Query(position, local, nearestSquared, nearestFace);
        // Written so that the products stay finite for any factor.
        var perBound = 1 / Math.Min(boundFactor, 1e30);
        if (local.MaximumComponent() < FarAway)
        {
            SearchNear(ref state, perBound);
        }
        else
        {
            SearchFar(ref state, 0, perBound);
        }

        (nearestSquared, nearestFace) = (state.NearestSquared, state.NearestFace);
        faceTests += state.FaceTests;
        boundTests += state.BoundTests;
    }

    /// <summary>Looks at every face, whatever the bounds say.</summary>
    /// <param name="position">In the mesh's frame.</param>
    /// <param name="nearestSquared">As in <see cref="Search"/>.</param>
    /// <param name="nearestFace">As in <see cref="Search"/>.</param>
    /// <param name="faceTests">Increased by the faces of the mesh.</param>
    public void LookAtAll(Vector position, ref double nearestSquared, ref int nearestFace, ref long faceTests)
    {
        for (var leaf = 0; leaf < _leaves.Length; leaf++)
        {
            Look(SquaredDistances(leaf, in position, nearestSquared), leaf, ref nearestSquared, ref nearestFace);
        }

        faceTests += _mesh.FaceCount;
    }

    /// <summary>A search as it goes on.</summary>
    private ref struct Query(Vector position, Vector local, double nearestSquared, int nearestFace)
    {
        public readonly Vector Position = position;
        public readonly Vector Local = local;
        public double NearestSquared = nearestSquared;
        public int NearestFace = nearestFace;
        public long FaceTests;
        public long BoundTests;
    }

    /// <summary>The factor and the summand that make of a squared distance the limit for bounds.</summary>
    /// <param name="perBound">1 / (1 + ε)².</param>
    /// <param name="slack">More than the relative error of a squared bound, twice.</param>
    /// <param name="magnitude">Of coordinates, in the boxes' units.</param>
    /// <remarks>
    /// With rounding, the kernel may find a face nearer than it is by δ = 2⁻⁴⁶·magnitude, some hundred last places of its coordinates; the
    /// face matters if its bound is below (d + δ)² ≤ (1 + s)·d² + (1 + 1/s)·δ², whatever the s.
    /// </remarks>
    private (double Factor, double Summand) Limit(double perBound, double slack, double magnitude) => (magnitude * Rounding) switch
    {
        var rounding => ((1 + (4 * slack)) * _scale * _scale * perBound, (1 + (1 / slack)) * rounding * rounding),
    };

    private void SearchNear(ref Query query, double perBound)
    {
        var (factor, summand) = Limit(perBound, NearSlack, _magnitude);
        var limit = (float)((query.NearestSquared * factor) + summand);
        var local = Single(Vector256.Create(query.Local.X, query.Local.Y, query.Local.Z, 0));
        var (below, above) = (local - LastPlace(local), local + LastPlace(local));
        var (belowX, belowY, belowZ) = (Vector256.Create(below[0]), Vector256.Create(below[1]), Vector256.Create(below[2]));
        var (aboveX, aboveY, aboveZ) = (Vector256.Create(above[0]), Vector256.Create(above[1]), Vector256.Create(above[2]));
        // The bound's bits above the child's number: bounds are not negative, so the entries sort like the bounds.
        Span<ulong> stack = stackalloc ulong[_stackSize];
        Span<uint> lanes = stackalloc uint[FaceHierarchyBuilder.Width];
        var (size, node, nodes) = (0, 0, 0);
        while (true)
        {
            if (node >= 0)
            {
                nodes++;
                var boxes = _boxes.AsSpan(node * HierarchyLayout.NodeVectors, HierarchyLayout.NodeVectors);
                var zero = Vector256<float>.Zero;
                var x = Vector256.MaxNative(Vector256.MaxNative(boxes[0] - aboveX, belowX - boxes[3]), zero);
                var y = Vector256.MaxNative(Vector256.MaxNative(boxes[1] - aboveY, belowY - boxes[4]), zero);
                var z = Vector256.MaxNative(Vector256.MaxNative(boxes[2] - aboveZ, belowZ - boxes[5]), zero);
                var bounds = (x * x) + (y * y) + (z * z);
                var nearer = Vector256.LessThan(bounds, Vector256.Create(limit)).ExtractMostSignificantBits();
                if (nearer != 0)
                {
                    bounds.AsUInt32().CopyTo(lanes);
                    ref var child = ref _children[node * FaceHierarchyBuilder.Width];
                    var bottom = size;
                    do
                    {
                        var lane = System.Numerics.BitOperations.TrailingZeroCount(nearer);
                        nearer &= nearer - 1;
                        var entry = ((ulong)lanes[lane] << 32) | (uint)Unsafe.Add(ref child, lane);
                        var place = size++;
                        // Nearest on top.
                        for (; place > bottom && stack[place - 1] < entry; place--)
                        {
                            stack[place] = stack[place - 1];
                        }

                        stack[place] = entry;
                    }
                    while (nearer != 0);
                }
            }
            else
            {
                if (LookAtLeaf(ref query, node))
                {
                    limit = (float)((query.NearestSquared * factor) + summand);
                }
            }

            do
            {
                if (size == 0 || query.NearestSquared == 0)
                {
                    query.BoundTests += nodes * FaceHierarchyBuilder.Width;
                    return;
                }
            }
            while (!(BitConverter.UInt32BitsToSingle((uint)(stack[--size] >> 32)) < limit));
            node = (int)(uint)stack[size];
        }
    }

    /// <summary>The same in double precision, slower, for positions far from the mesh.</summary>
    private void SearchFar(ref Query query, int node, double perBound)
    {
        var (factor, summand) = Limit(perBound, FarSlack, _magnitude + query.Local.MaximumComponent());
        Span<double> bounds = stackalloc double[FaceHierarchyBuilder.Width];
        var boxes = MemoryMarshal.Cast<Vector256<float>, float>(_boxes.AsSpan(node * HierarchyLayout.NodeVectors, HierarchyLayout.NodeVectors));
        for (var child = 0; child < bounds.Length; child++)
        {
            Vector minimum = new(boxes[child], boxes[8 + child], boxes[16 + child]), maximum = new(boxes[24 + child], boxes[32 + child], boxes[40 + child]);
            bounds[child] = Vector.Max(Vector.Max(minimum - query.Local, query.Local - maximum), Vector.Zero).LengthSquared();
        }

        query.BoundTests += FaceHierarchyBuilder.Width;
        while (true)
        {
            var nearest = 0;
            for (var child = 1; child < bounds.Length; child++)
            {
                nearest = bounds[child] < bounds[nearest] ? child : nearest;
            }

            if (!(bounds[nearest] < (query.NearestSquared * factor) + summand) || query.NearestSquared == 0)
            {
                return;
            }

            bounds[nearest] = double.PositiveInfinity;
            var next = _children[(node * FaceHierarchyBuilder.Width) + nearest];
            if (next >= 0)
            {
                SearchFar(ref query, next, perBound);
            }
            else
            {
                LookAtLeaf(ref query, next);
            }
        }
    }

    private bool LookAtLeaf(ref Query query, int child)
    {
        var number = (uint)~child;
        var leaf = (int)(number / FaceHierarchyBuilder.LeafFaces);
        query.FaceTests += (number % FaceHierarchyBuilder.LeafFaces) + 1;
        return Look(SquaredDistances(leaf, in query.Position, query.NearestSquared), leaf, ref query.NearestSquared, ref query.NearestFace);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Vector256<double> SquaredDistances(int leaf, ref readonly Vector position, double nearestSquared) => _quartets.Length > 0
        ? FaceQuartet.SquaredDistances(in _quartets[leaf], in position, nearestSquared)
        : FaceQuartet.SquaredDistances(in _leaves[leaf], _mesh.Positions.AsSpan(), in position);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private bool Look(Vector256<double> squared, int leaf, ref double nearestSquared, ref int nearestFace)
    {
        if (!Vector256.LessThanAny(squared, Vector256.Create(nearestSquared)))
        {
            return false;
        }

        Choose(squared, in _leaves[leaf], ref nearestSquared, ref nearestFace);
        return true;
    }

    private static void Choose(Vector256<double> squared, ref readonly HierarchyLeaf leaf, ref double nearestSquared, ref int nearestFace)
    {
        for (var i = 0; i < FaceHierarchyBuilder.LeafFaces; i++)
        {
            if (squared[i] < nearestSquared)
            {
                (nearestSquared, nearestFace) = (squared[i], leaf.Face[i]);
            }
        }
    }

    private FaceQuartet Quartet(HierarchyLeaf leaf) => _mesh.Positions.AsSpan() switch
    {
        var positions => new(
            VectorQuartet.Gather(positions, leaf.A), VectorQuartet.Gather(positions, leaf.B), VectorQuartet.Gather(positions, leaf.C)),
    };

    /// <summary>Rounded to single precision, to nearest.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector128<float> Single(Vector256<double> v) => Vector128.Narrow(v.GetLower(), v.GetUpper());

    /// <summary>At least the distance to the next float, in either direction.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    internal static Vector128<float> LastPlace(Vector128<float> v) => (Vector128.Abs(v) * 1.1920929e-7f) + Vector128.Create(1.1754944e-38f);

    private static double PowerOfTwoBelow(double halfSize) =>
        halfSize > 0 && double.IsFinite(halfSize) ? Math.ScaleB(1, -Math.Clamp(Math.ILogB(halfSize), -400, 400)) : 1;

    private int Depth(int node)
    {
        var deepest = 0;
        for (var slot = node * FaceHierarchyBuilder.Width; slot < (node + 1) * FaceHierarchyBuilder.Width; slot++)
        {
            deepest = _children[slot] >= 0 ? Math.Max(deepest, Depth(_children[slot])) : deepest;
        }

        return deepest + 1;
    }
}
