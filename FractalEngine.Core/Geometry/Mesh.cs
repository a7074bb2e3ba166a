using System.Collections.Immutable;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>
/// A triangle mesh as plain data: flat arrays, immutable, not tied to any file, collider or graphics API.
/// Front faces are wound so that <c>Cross(b − a, c − a)</c> points outwards.
/// </summary>
public sealed record Mesh
{
    private StrongBox<BoundingBox>? _usedBounds;

    /// <summary>Makes a mesh of positions and faces.</summary>
    /// <param name="positions">Coordinates, [vertices × 3].</param>
    /// <param name="vertexIndices">Indices of vertices from 0, [faces × 3].</param>
    /// <exception cref="ArgumentException">
    /// A length is not a multiple of three, a coordinate is NaN or infinite, or a vertex number is out of range.
    /// </exception>
    public Mesh(ImmutableArray<double> positions, ImmutableArray<int> vertexIndices)
    {
        ArgumentCheck.Require(!positions.IsDefault && positions.Length % 3 == 0, "expected three coordinates a vertex", nameof(positions));
        Bounds = BoundsOf(positions.AsSpan());
        // A minimum or maximum with NaN is NaN, so that the bounds of other coordinates are never finite.
        ArgumentCheck.Require(
            positions.IsEmpty || (Bounds.Minimum.IsFinite() && Bounds.Maximum.IsFinite()), "expected finite coordinates",
            nameof(positions));
        Positions = positions;
        VertexIndices = vertexIndices;
        RequireIndices(vertexIndices, null, positions.Length / 3, 0, nameof(vertexIndices));
    }

    /// <summary>The mesh without vertices.</summary>
    public static Mesh Empty { get; } = new([], []);

    /// <summary>Vertex coordinates in scene units, [<see cref="VertexCount"/> × 3].</summary>
    public ImmutableArray<double> Positions { get; }

    /// <summary>Indices of vertices from 0, [<see cref="FaceCount"/> × 3].</summary>
    public ImmutableArray<int> VertexIndices { get; }

    /// <summary>Colours of the vertices, sRGB from 0 to 1, [<see cref="VertexCount"/> × 3]; empty when the mesh has none.</summary>
    public ImmutableArray<double> Colours { get; private init; } = [];

    /// <summary>Texture coordinates (u, v), v upwards, [n × 2]; empty when the mesh has none.</summary>
    public ImmutableArray<double> TextureCoordinates { get; private init; } = [];

    /// <summary>Indices into <see cref="TextureCoordinates"/>, −1 for none, [<see cref="FaceCount"/> × 3], or empty.</summary>
    public ImmutableArray<int> TextureIndices { get; private init; } = [];

    /// <summary>Normals as the file gives them, of any length, [n × 3]; empty when the mesh has none.</summary>
    public ImmutableArray<double> Normals { get; private init; } = [];

    /// <summary>Indices into <see cref="Normals"/>, −1 for none, [<see cref="FaceCount"/> × 3], or empty.</summary>
    public ImmutableArray<int> NormalIndices { get; private init; } = [];

    /// <summary>The faces in runs of one name and material, in order; together they cover all faces, or there are none.</summary>
    public ImmutableArray<MeshGroup> Groups { get; private init; } = [];

    /// <summary>Material files as the mesh's file names them (<c>mtllib</c>).</summary>
    public ImmutableArray<string> MaterialLibraries { get; private init; } = [];

    /// <summary>Number of vertices in the mesh, unused ones included.</summary>
    public int VertexCount => Positions.Length / 3;

    /// <summary>Number of triangles in the mesh.</summary>
    public int FaceCount => VertexIndices.Length / 3;

    /// <summary>The corner behind another one in the same face, both counted through all faces.</summary>
    internal static int NextCorner(int corner) => corner % 3 == 2 ? corner - 2 : corner + 1;

    /// <summary>The box of all vertices, unused ones included.</summary>
    public BoundingBox Bounds { get; }

    /// <summary>The box of the vertices that faces use, found when it is first asked for.</summary>
    public BoundingBox UsedBounds => (_usedBounds ??= new(ComputeUsedBounds())).Value;

    /// <summary>Makes the same mesh with colours of its vertices.</summary>
    /// <param name="colours">sRGB, [vertices × 3]. Drawing limits them to the range from 0 to 1.</param>
    /// <exception cref="ArgumentException">There are not three components a vertex.</exception>
    public Mesh WithColours(ImmutableArray<double> colours)
    {
        ArgumentCheck.Require(
            !colours.IsDefault && colours.Length == Positions.Length, "expected three components a vertex", nameof(colours));
        return this with { Colours = colours };
    }

    /// <summary>Makes the same mesh with texture coordinates.</summary>
    /// <param name="coordinates">(u, v), [n × 2].</param>
    /// <param name="indices">Indices into them, −1 for none, [faces × 3].</param>
    public Mesh WithTextureCoordinates(ImmutableArray<double> coordinates, ImmutableArray<int> indices)
    {
        ArgumentCheck.Require(!coordinates.IsDefault && coordinates.Length % 2 == 0, "expected two coordinates each", nameof(coordinates));
        RequireIndices(indices, VertexIndices.Length, coordinates.Length / 2, -1, nameof(indices));
        return this with { TextureCoordinates = coordinates, TextureIndices = indices };
    }

    /// <summary>Makes the same mesh with normals.</summary>
    /// <param name="normals">[n × 3].</param>
    /// <param name="indices">Indices into them, −1 for none, [faces × 3].</param>
    public Mesh WithNormals(ImmutableArray<double> normals, ImmutableArray<int> indices)
    {
        ArgumentCheck.Require(!normals.IsDefault && normals.Length % 3 == 0, "expected three components each", nameof(normals));
        RequireIndices(indices, VertexIndices.Length, normals.Length / 3, -1, nameof(indices));
        return this with { Normals = normals, NormalIndices = indices };
    }

    /// <summary>Makes the same mesh with named runs of faces.</summary>
    public Mesh WithGroups(ImmutableArray<MeshGroup> groups, ImmutableArray<string> materialLibraries) =>
        this with { Groups = groups, MaterialLibraries = materialLibraries };

    /// <summary>The position of a vertex.</summary>
    /// <param name="vertex">From 0.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector Vertex(int vertex) =>
        new(Positions[3 * vertex], Positions[(3 * vertex) + 1], Positions[(3 * vertex) + 2]);

    /// <summary>Computes the area of all faces together, scene units².</summary>
    public double SurfaceArea()
    {
        var area = 0.0;
        for (var face = 0; face < FaceCount; face++)
        {
            var (a, b, c) = Face(face);
            area += 0.5 * Vector.Cross(b - a, c - a).Length();
        }

        return area;
    }

    /// <summary>The three corners of a face.</summary>
    /// <param name="face">From 0.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public (Vector A, Vector B, Vector C) Face(int face) =>
        (Vertex(VertexIndices[3 * face]), Vertex(VertexIndices[(3 * face) + 1]), Vertex(VertexIndices[(3 * face) + 2]));

    /// <summary>
    /// Finds the distance of the farthest vertex from the image of the origin under a map (paper §4.3.3):
    /// max |m·v − m.position|; 0 for an empty mesh. Cost O(vertices).
    /// </summary>
    public double Radius(AffineMap map)
    {
        var maxDistance = 0.0;
        for (var vertex = 0; vertex < VertexCount; vertex++)
        {
            maxDistance = Math.Max(maxDistance, (map.Linear * Vertex(vertex)).Length());
        }

        return maxDistance;
    }

    /// <summary>Computes the box of all vertices under a map, unused ones included. Cost O(vertices).</summary>
    internal BoundingBox ComputeBounds(AffineMap map)
    {
        if (map == AffineMap.Identity)
        {
            return Bounds;
        }

        var box = BoundingBox.Empty;
        for (var vertex = 0; vertex < VertexCount; vertex++)
        {
            box = box.Including(map * Vertex(vertex));
        }

        return box;
    }

    /// <summary>Tells whether all arrays of both meshes are equal, each number bit for bit.</summary>
    public bool Equals(Mesh? other) => ReferenceEquals(this, other) || (other is not null
        && HaveSameBits(Positions, other.Positions) && VertexIndices.AsSpan().SequenceEqual(other.VertexIndices.AsSpan())
        && HaveSameBits(Colours, other.Colours) && HaveSameBits(TextureCoordinates, other.TextureCoordinates)
        && TextureIndices.AsSpan().SequenceEqual(other.TextureIndices.AsSpan())
        && HaveSameBits(Normals, other.Normals) && NormalIndices.AsSpan().SequenceEqual(other.NormalIndices.AsSpan())
        && Groups.AsSpan().SequenceEqual(other.Groups.AsSpan()) && MaterialLibraries.SequenceEqual(other.MaterialLibraries));

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(VertexCount, FaceCount, Bounds);

    // The first collider of a mesh waits for this, mostly before the tiers of the compiler have warmed up.
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private BoundingBox ComputeUsedBounds()
    {
        var minimum = Vector256.Create(double.PositiveInfinity);
        var maximum = -minimum;
        foreach (var vertex in VertexIndices)
        {
            var position = SimdAffineMap.ToVector256(Vertex(vertex));
            minimum = Vector256.Min(minimum, position);
            maximum = Vector256.Max(maximum, position);
        }

        return new(SimdAffineMap.ToVector(minimum), SimdAffineMap.ToVector(maximum));
    }

    private static bool HaveSameBits(ImmutableArray<double> numbers1, ImmutableArray<double> numbers2) =>
        MemoryMarshal.AsBytes(numbers1.AsSpan()).SequenceEqual(MemoryMarshal.AsBytes(numbers2.AsSpan()));

    private static void RequireIndices(ImmutableArray<int> indices, int? length, int count, int minIndex, string name)
    {
        ArgumentCheck.Require(
            !indices.IsDefault && indices.Length % 3 == 0 && (length ?? indices.Length) == indices.Length, "expected three indices a face",
            name);
        ArgumentCheck.Require(AreWithin(indices.AsSpan(), minIndex, count - 1), "expected indices of elements that exist", name);
    }

    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static bool AreWithin(ReadOnlySpan<int> indices, int minIndex, int maxIndex)
    {
        var vectors = MemoryMarshal.Cast<int, Vector256<int>>(indices);
        var (min, max) = (Vector256.Create(minIndex), Vector256.Create(maxIndex));
        var outside = Vector256<int>.Zero;
        foreach (var vector in vectors)
        {
            outside |= Vector256.LessThan(vector, min) | Vector256.GreaterThan(vector, max);
        }

        var areWithin = outside == Vector256<int>.Zero;
        foreach (var index in indices[(vectors.Length * Vector256<int>.Count)..])
        {
            areWithin &= index >= minIndex && index <= maxIndex;
        }

        return areWithin;
    }

    /// <summary>Computes the box of positions; it has NaN where a coordinate is NaN.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static BoundingBox BoundsOf(ReadOnlySpan<double> positions)
    {
        // Three vectors hold four positions. Each of their lanes is always the same coordinate.
        const int Period = 12;
        var wholeLength = positions.Length - (positions.Length % Period);
        var vectors = MemoryMarshal.Cast<double, Vector256<double>>(positions[..wholeLength]);
        var infinity = Vector256.Create(double.PositiveInfinity);
        var (min0, min1, min2) = (infinity, infinity, infinity);
        var (max0, max1, max2) = (-infinity, -infinity, -infinity);
        for (var i = 0; i + 2 < vectors.Length; i += 3)
        {
            min0 = Vector256.Min(min0, vectors[i]);
            max0 = Vector256.Max(max0, vectors[i]);
            min1 = Vector256.Min(min1, vectors[i + 1]);
            max1 = Vector256.Max(max1, vectors[i + 1]);
            min2 = Vector256.Min(min2, vectors[i + 2]);
            max2 = Vector256.Max(max2, vectors[i + 2]);
        }

        Span<Vector256<double>> extremes = [min0, min1, min2, max0, max1, max2];
        var box = BoundingBox.Empty;
        if (wholeLength > 0)
        {
            box = IncludeAll(box, MemoryMarshal.Cast<Vector256<double>, double>(extremes));
        }

        return IncludeAll(box, positions[wholeLength..]);
    }

    private static BoundingBox IncludeAll(BoundingBox box, ReadOnlySpan<double> positions)
    {
        for (var i = 0; i + 2 < positions.Length; i += 3)
        {
            box = box.Including(new(positions[i], positions[i + 1], positions[i + 2]));
        }

        return box;
    }
}
