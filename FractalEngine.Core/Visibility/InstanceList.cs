using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Core.Visibility.Sky;

namespace FractalEngine.Core.Visibility;

/// <summary>A growing list of instances in the form that the GPU takes: rows of 3×4 maps in single precision.</summary>
/// <param name="hasPathHashes">Whether the list keeps hashes that tell the instances of one object apart.</param>
internal sealed class InstanceList(bool hasPathHashes)
{
    /// <summary>Number of floats that one instance takes.</summary>
    public const int FloatsPerInstance = 12;

    /// <summary>Number of floats that one tint takes.</summary>
    public const int FloatsPerTint = 4;

    // The list grows by a quarter, so that most of the memory is used.
    private const int GrowthDivisor = 4;

    private readonly List<int> _ends = [];
    private float[] _rows = new float[64 * FloatsPerInstance];
    private float[] _gradientFactors = [];
    private float[] _coveredSides = [];
    private float[] _skyParts = [];
    private float[] _tints = [];
    private float[] _paletteColours = [];
    private ulong[] _pathHashes = [];

    /// <summary>Number of instances in the list.</summary>
    public int Count { get; private set; }

    /// <summary>Hashes that tell the instances of one object apart, [<see cref="Count"/>].</summary>
    public ReadOnlySpan<ulong> PathHashes => _pathHashes.AsSpan(0, Count);

    /// <summary>Rows of the maps of an object's instances, [n × 12].</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public ReadOnlySpan<float> RowsOf(int rank) => Slice(_rows, FloatsPerInstance, rank);

    /// <summary>Gradient factors from 0 to 1 of the instances of an object with a gradient, [n].</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public ReadOnlySpan<float> GradientFactorsOf(int rank) => Slice(_gradientFactors, 1, rank);

    /// <summary>Covered sides of the instances of an object with such: the sums of their bits, [n].</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public ReadOnlySpan<float> CoveredSidesOf(int rank) => Slice(_coveredSides, 1, rank);

    /// <summary>Tints of the instances of an object with colours: what is added, and what is kept, [n × 4].</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public ReadOnlySpan<float> TintsOf(int rank) => Slice(_tints, FloatsPerTint, rank);

    /// <summary>Colours of the instances of an object with a palette: linear light and 0, [n × 4].</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public ReadOnlySpan<float> PaletteColoursOf(int rank) => Slice(_paletteColours, FloatsPerTint, rank);

    /// <summary>Parts of the sky that the six sides of the instances of an object with masks see, [n × 6].</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public ReadOnlySpan<float> SkyPartsOf(int rank) => Slice(_skyParts, AmbientCube.Count, rank);

    /// <summary>The range of an object's instances.</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public (int Start, int Count) RangeOf(int rank)
    {
        var start = rank == 0 ? 0 : _ends[rank - 1];
        return (start, _ends[rank] - start);
    }

    /// <summary>Removes all instances, and keeps the memory for the next ones.</summary>
    public void Clear()
    {
        Count = 0;
        _ends.Clear();
    }

    /// <summary>Ends the instances of one object; those of the next one follow.</summary>
    public void EndObject() => _ends.Add(Count);

    /// <summary>Appends an instance to the list.</summary>
    /// <param name="map">Map from the frame of the base mesh.</param>
    /// <param name="vertexOrigin">Point of that frame that the drawn vertices are relative to.</param>
    /// <param name="pathHash">Hash that tells the instance apart from others of its object.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public void Add(in SimdAffineMap map, Vector256<double> vertexOrigin, ulong pathHash)
    {
        EnsureCapacity();
        var v1 = ToSingle(map.V1);
        var v2 = ToSingle(map.V2);
        var v3 = ToSingle(map.V3);
        var translation = ToSingle(map.Apply(vertexOrigin));
        ref var target = ref Unsafe.Add(ref MemoryMarshal.GetArrayDataReference(_rows), Count * FloatsPerInstance);
        Vector128.Create(v1[0], v2[0], v3[0], translation[0]).StoreUnsafe(ref target);
        Vector128.Create(v1[1], v2[1], v3[1], translation[1]).StoreUnsafe(ref target, 4);
        Vector128.Create(v1[2], v2[2], v3[2], translation[2]).StoreUnsafe(ref target, 8);
        if (hasPathHashes)
        {
            _pathHashes[Count] = pathHash;
        }

        Count++;
    }

    /// <summary>Appends an instance of another list, with its gradient factor.</summary>
    /// <param name="other">List that has path hashes if this one has.</param>
    /// <param name="index">Index of the instance in the other list.</param>
    public void AddFrom(InstanceList other, int index)
    {
        EnsureCapacity();
        other._rows.AsSpan(index * FloatsPerInstance, FloatsPerInstance).CopyTo(_rows.AsSpan(Count * FloatsPerInstance));
        if (hasPathHashes)
        {
            _pathHashes[Count] = other._pathHashes[index];
        }

        Count++;
        if (index < other._gradientFactors.Length)
        {
            SetGradientFactor(other._gradientFactors[index]);
        }

        if (index < other._coveredSides.Length)
        {
            SetCoveredSides(other._coveredSides[index]);
        }

        if (index * FloatsPerTint < other._paletteColours.Length)
        {
            SetVector(ref _paletteColours, Vector128.Create<float>(other._paletteColours.AsSpan(index * FloatsPerTint, FloatsPerTint)));
        }

        if (index * FloatsPerTint < other._tints.Length)
        {
            SetTint(Vector128.Create<float>(other._tints.AsSpan(index * FloatsPerTint, FloatsPerTint)));
        }

        if (index * AmbientCube.Count < other._skyParts.Length)
        {
            other._skyParts.AsSpan(index * AmbientCube.Count, AmbientCube.Count).CopyTo(LastSkyParts());
        }
    }

    /// <summary>Sets the gradient factor of the last instance, a number from 0 to 1.</summary>
    public void SetGradientFactor(float gradientFactor)
    {
        if (_gradientFactors.Length < Count)
        {
            Array.Resize(ref _gradientFactors, _rows.Length / FloatsPerInstance);
        }

        _gradientFactors[Count - 1] = gradientFactor;
    }

    /// <summary>Sets the covered sides of the last instance.</summary>
    public void SetCoveredSides(float sides)
    {
        if (_coveredSides.Length < Count)
        {
            Array.Resize(ref _coveredSides, _rows.Length / FloatsPerInstance);
        }

        _coveredSides[Count - 1] = sides;
    }

    /// <summary>Sets the tint of the last instance.</summary>
    public void SetTint(Vector128<float> tint) => SetVector(ref _tints, tint);

    /// <summary>Sets the gradient factor of the last instance, and its colour where a palette has one.</summary>
    public void SetShade(GradientShade shade, bool hasPalette)
    {
        SetGradientFactor((float)shade.Factor);
        if (hasPalette)
        {
            SetVector(ref _paletteColours, new Tint(shade.Colour, 0).ToSingle());
        }
    }

    private void SetVector(ref float[] values, Vector128<float> value)
    {
        if (values.Length < Count * FloatsPerTint)
        {
            Array.Resize(ref values, _rows.Length / FloatsPerInstance * FloatsPerTint);
        }

        value.CopyTo(values.AsSpan((Count - 1) * FloatsPerTint));
    }

    /// <summary>Returns the place of the last instance's parts of the sky.</summary>
    public Span<float> LastSkyParts()
    {
        if (_skyParts.Length < Count * AmbientCube.Count)
        {
            Array.Resize(ref _skyParts, _rows.Length / FloatsPerInstance * AmbientCube.Count);
        }

        return _skyParts.AsSpan((Count - 1) * AmbientCube.Count, AmbientCube.Count);
    }

    private ReadOnlySpan<float> Slice(float[] values, int floatsPerInstance, int rank)
    {
        var (start, count) = RangeOf(rank);
        // Factors and parts end with those of the last object that has some, before an empty range.
        return count == 0 ? [] : values.AsSpan(start * floatsPerInstance, count * floatsPerInstance);
    }

    private void EnsureCapacity()
    {
        if (Count == _rows.Length / FloatsPerInstance)
        {
            Array.Resize(ref _rows, (Count + (Count / GrowthDivisor) + 16) * FloatsPerInstance);
        }

        if (hasPathHashes && _pathHashes.Length < _rows.Length / FloatsPerInstance)
        {
            Array.Resize(ref _pathHashes, _rows.Length / FloatsPerInstance);
        }
    }

    private static Vector128<float> ToSingle(Vector256<double> v) => Vector128.Narrow(v.GetLower(), v.GetUpper());
}
