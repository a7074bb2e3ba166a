using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Detail;

/// <summary>A part of a fractal with some number of levels left, as it is drawn: the copies that it is made of, and a box that holds it.</summary>
internal sealed class DetailState
{
    /// <summary>Boxes are kept in vectors of so many.</summary>
    public const int Lanes = 8;

    /// <summary>Rows of a vector of boxes: x, y, z of the centres, then of half the sizes.</summary>
    public const int Rows = 6;

    // Of a copy's size: more than what single precision rounds by.
    private const double Rounding = 1e-6;

    // Of its distance from the middle: half a unit in the last place.
    private const double SinglePrecision = 6e-8;

    /// <summary>For a level.</summary>
    /// <param name="box">Holds everything, in this frame.</param>
    /// <param name="standIn">From the base mesh's frame to this one: how the mesh stands for everything when it is too small to be told apart.</param>
    /// <param name="children">The copies, none of them twice; none for the base.</param>
    public DetailState(BoundingBox box, AffineMap standIn, ReadOnlySpan<DetailChild> children)
    {
        (Box, StandIn, IsEmpty) = (box, new(standIn), box.IsEmpty);
        IsStandInIdentity = standIn == AffineMap.Identity;
        var padded = (children.Length + Lanes - 1) / Lanes * Lanes;
        (Maps, Downs, Indices, Boxes) = (new AffineLanes[children.Length], new long[children.Length], new int[children.Length], new float[padded * Rows]);
        if (IsEmpty)
        {
            return;
        }

        (Centre, HalfSize) = (AffineLanes.Of(box.Centre), AffineLanes.Of(0.5 * box.Size));
        var largest = box.Diagonal + box.Centre.MaximumComponent();
        for (var i = 0; i < children.Length; i++)
        {
            var (map, childBox, down, index) = children[i];
            (Maps[i], Downs[i], Indices[i]) = (new(map), down, index);
            var offset = childBox.Centre - box.Centre;
            var rounding = (Rounding * (childBox.Diagonal + (Rounding * largest))) + (SinglePrecision * offset.MaximumComponent());
            Write(offset, i, 0);
            Write((0.5 * childBox.Size) + (rounding * Vector.One), i, 3);
            Ratio = Math.Max(Ratio, childBox.Diagonal / box.Diagonal);
        }
    }

    /// <summary>True when there is nothing to draw.</summary>
    public bool IsEmpty { get; }

    /// <summary>Holds everything, in this frame.</summary>
    public BoundingBox Box { get; }

    /// <summary>Of the box: x, y, z, 0.</summary>
    public Vector256<double> Centre { get; }

    /// <summary>Half the size of the box: x, y, z, 0.</summary>
    public Vector256<double> HalfSize { get; }

    /// <summary>From the base mesh's frame to this one.</summary>
    public AffineLanes StandIn { get; }

    /// <summary>Nearly always.</summary>
    public bool IsStandInIdentity { get; }

    /// <summary>From the frames of the copies to this one.</summary>
    public AffineLanes[] Maps { get; }

    /// <summary>
    /// Boxes that hold the copies, in this frame, relative to its box's centre: for each eight copies six rows of eight numbers, see <see cref="Rows"/>.
    /// </summary>
    public float[] Boxes { get; }

    /// <summary>The size of the largest copy as a part of this one's.</summary>
    public double Ratio { get; }

    /// <summary>How many levels the copies go down, see <see cref="CopyStep"/>.</summary>
    public long[] Downs { get; }

    /// <summary>The numbers of the copies' maps in their sets; −1 for the identity, which changes no colour.</summary>
    public int[] Indices { get; }

    private void Write(Vector v, int child, int row)
    {
        var start = (child / Lanes * Lanes * Rows) + (row * Lanes) + (child % Lanes);
        (Boxes[start], Boxes[start + Lanes], Boxes[start + (2 * Lanes)]) = ((float)v.X, (float)v.Y, (float)v.Z);
    }
}

/// <summary>One of the copies that a <see cref="DetailState"/> is made of.</summary>
/// <param name="Map">From its frame.</param>
/// <param name="Box">Holds it, in the frame of the state.</param>
/// <param name="Down">As in <see cref="CopyStep"/>.</param>
/// <param name="Index">Of the map in its set, −1 for the identity.</param>
internal readonly record struct DetailChild(AffineMap Map, BoundingBox Box, long Down, int Index);
