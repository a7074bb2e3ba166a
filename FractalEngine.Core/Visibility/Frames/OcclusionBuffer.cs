using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Visibility.Frames;

/// <summary>The inverse depth of the closest surface at each pixel of a strip of a frame.</summary>
/// <remarks>
/// Inverse depth is linear on the screen: 1 divided by the depth in perspective, the negative depth otherwise. Tiles of 8 × 8 pixels keep
/// the minimum of their pixels, so that most hidden rectangles are found without reading pixels.
/// </remarks>
internal sealed class OcclusionBuffer
{
    /// <summary>Side of a tile in pixels, and number of pixels in one vector.</summary>
    public const int TileSize = 8;

    private float[] _inverseDepths = [];
    private float[] _tileMinInverseDepths = [];
    private bool[] _isTileStale = [];
    private Vector256<float> _columnOffsets;
    private (float Even, float Odd) _rowOffsets;
    private float _minSampleOffset;
    private float _maxSampleOffset;
    private int _stride;
    private int _tilesPerRow;

    /// <summary>First column of the strip.</summary>
    public int Left { get; private set; }

    /// <summary>One more than the last column of the strip.</summary>
    public int Right { get; private set; }

    /// <summary>Number of rows of the frame.</summary>
    public int Height { get; private set; }

    /// <summary>The smallest and largest coordinate of a sample within its pixel.</summary>
    /// <param name="isMultisampled">As in <see cref="Clear"/>.</param>
    public static (float Min, float Max) SampleOffsets(bool isMultisampled) => isMultisampled ? (0.25f, 0.75f) : (0.5f, 0.5f);

    /// <summary>Begins a new frame without any surface.</summary>
    /// <param name="left">First column of the strip.</param>
    /// <param name="right">One more than the last column.</param>
    /// <param name="height">Number of rows of the frame.</param>
    /// <param name="isMultisampled">
    /// True where pixels are quarters of pixels that have four samples: each sample then lies where graphics hardware has it (the standard
    /// pattern of Direct3D 11, which OpenGL drivers follow), else at the centre.
    /// </param>
    public void Clear(int left, int right, int height, bool isMultisampled = false)
    {
        _rowOffsets = isMultisampled ? new(0.25f, 0.75f) : new(0.5f, 0.5f);
        _columnOffsets = Vector256.Create(isMultisampled ? 0.75f : 0.5f, isMultisampled ? 0.25f : 0.5f, 0, 0, 0, 0, 0, 0);
        _columnOffsets = Vector256.Shuffle(_columnOffsets, Vector256.Create(0, 1, 0, 1, 0, 1, 0, 1));
        (_minSampleOffset, _maxSampleOffset) = SampleOffsets(isMultisampled);
        Left = left;
        Right = right;
        Height = height;
        _tilesPerRow = (right - left + TileSize - 1) / TileSize;
        // Vectors of eight pixels may begin at any column.
        _stride = (_tilesPerRow + 1) * TileSize;
        var rows = (height + TileSize - 1) / TileSize;
        var pixels = _stride * rows * TileSize;
        var tiles = _tilesPerRow * rows;
        if (_inverseDepths.Length < pixels || _tileMinInverseDepths.Length < tiles)
        {
            _inverseDepths = new float[pixels];
            _tileMinInverseDepths = new float[tiles];
            _isTileStale = new bool[tiles];
        }

        _inverseDepths.AsSpan(0, pixels).Fill(float.NegativeInfinity);
        _tileMinInverseDepths.AsSpan(0, tiles).Fill(float.NegativeInfinity);
        _isTileStale.AsSpan(0, tiles).Clear();
    }

    /// <summary>Tests whether all pixels of a rectangle have surfaces at least as close as an inverse depth.</summary>
    /// <param name="left">First column, within the strip.</param>
    /// <param name="top">First row.</param>
    /// <param name="right">Last column, no less than the first.</param>
    /// <param name="bottom">Last row, no less than the first.</param>
    /// <param name="maxInverseDepth">Largest inverse depth of what is tested.</param>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    public bool IsOccluded(int left, int top, int right, int bottom, float maxInverseDepth)
    {
        left -= Left;
        right -= Left;
        for (var tileY = top / TileSize; tileY <= bottom / TileSize; tileY++)
        {
            for (var tileX = left / TileSize; tileX <= right / TileSize; tileX++)
            {
                if (!(TileMinInverseDepth(tileX, tileY) >= maxInverseDepth)
                    && !IsTileOccluded(tileX, tileY, left, top, right, bottom, maxInverseDepth))
                {
                    return false;
                }
            }
        }

        return true;
    }

    /// <summary>Rasterizes a triangle with corners a, b and c.</summary>
    /// <remarks>Coordinates x and y are pixels of the frame, y downwards.</remarks>
    /// <returns>True when the triangle is the closest surface at some sample.</returns>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    public bool RasterizeTriangle(
        float ax, float ay, float aInverseDepth,
        float bx, float by, float bInverseDepth,
        float cx, float cy, float cInverseDepth)
    {
        // Far coordinates are clamped before they become integers.
        var left = Math.Max(FirstSampleIndex(Math.Min(Math.Min(ax, bx), cx)), Left);
        var right = Math.Min(LastSampleIndex(Math.Max(Math.Max(ax, bx), cx)), Right - 1);
        var top = Math.Max(FirstSampleIndex(Math.Min(Math.Min(ay, by), cy)), 0);
        var bottom = Math.Min(LastSampleIndex(Math.Max(Math.Max(ay, by), cy)), Height - 1);
        if (left > right || top > bottom)
        {
            return false;
        }

        var (abX, abY, acX, acY) = (bx - ax, by - ay, cx - ax, cy - ay);
        var area = (abX * acY) - (abY * acX);
        if (area == 0)
        {
            return false;
        }

        // Barycentric weights of b and c as linear functions of the position, and from them the inverse depth.
        var perArea = 1 / area;
        var (ub, vb) = (acY * perArea, -acX * perArea);
        var (uc, vc) = (-abY * perArea, abX * perArea);
        var (abInverseDepth, acInverseDepth) = (bInverseDepth - aInverseDepth, cInverseDepth - aInverseDepth);
        var (slopeX, slopeY) = ((ub * abInverseDepth) + (uc * acInverseDepth), (vb * abInverseDepth) + (vc * acInverseDepth));
        var columns = Vector256.Create(0f, 1, 2, 3, 4, 5, 6, 7);
        var isVisible = false;
        ref var pixels = ref MemoryMarshal.GetArrayDataReference(_inverseDepths);
        for (var x = left; x <= right; x += TileSize)
        {
            var dx = Vector256.Create(x - ax) + columns;
            // Samples of even columns have other offsets than those of odd ones.
            var offsets = (x & 1) == 0 ? _columnOffsets : Vector256.Shuffle(_columnOffsets, Vector256.Create(1, 0, 1, 0, 1, 0, 1, 0));
            var columnWeightB = Vector256.Create(ub) * dx;
            var columnWeightC = Vector256.Create(uc) * dx;
            var columnInverseDepth = Vector256.Create(aInverseDepth) + (Vector256.Create(slopeX) * dx);
            var columnMask = Vector256.LessThanOrEqual(columns, Vector256.Create((float)(right - x)));
            for (var y = top; y <= bottom; y++)
            {
                var dy = Vector256.Create(y - ay) + offsets;
                var ox = (y & 1) == 0 ? _rowOffsets.Even : _rowOffsets.Odd;
                var weightB = columnWeightB + (Vector256.Create(vb) * dy) + Vector256.Create(ub * ox);
                var weightC = columnWeightC + (Vector256.Create(vc) * dy) + Vector256.Create(uc * ox);
                var isInside = Vector256.GreaterThanOrEqual(weightB, Vector256<float>.Zero)
                    & Vector256.GreaterThanOrEqual(weightC, Vector256<float>.Zero)
                    & Vector256.LessThanOrEqual(weightB + weightC, Vector256<float>.One)
                    & columnMask;
                if (isInside == Vector256<float>.Zero)
                {
                    continue;
                }

                var inverseDepth = columnInverseDepth + (Vector256.Create(slopeY) * dy) + Vector256.Create(slopeX * ox);
                var pixelOffset = (nuint)((y * _stride) + x - Left);
                var storedInverseDepth = Vector256.LoadUnsafe(ref pixels, pixelOffset);
                var isCloser = isInside & Vector256.GreaterThan(inverseDepth, storedInverseDepth);
                if (isCloser != Vector256<float>.Zero)
                {
                    Vector256.ConditionalSelect(isCloser, inverseDepth, storedInverseDepth).StoreUnsafe(ref pixels, pixelOffset);
                    isVisible = true;
                }
            }
        }

        if (isVisible)
        {
            MarkStale(left, top, right, bottom);
        }

        return isVisible;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private int FirstSampleIndex(float coordinate) => (int)MathF.Ceiling(Math.Max(coordinate, -1e6f) - _maxSampleOffset);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private int LastSampleIndex(float coordinate) => (int)MathF.Floor(Math.Min(coordinate, 1e6f) - _minSampleOffset);

    private void MarkStale(int left, int top, int right, int bottom)
    {
        for (var tileY = top / TileSize; tileY <= bottom / TileSize; tileY++)
        {
            for (var tileX = (left - Left) / TileSize; tileX <= (right - Left) / TileSize; tileX++)
            {
                _isTileStale[(tileY * _tilesPerRow) + tileX] = true;
            }
        }
    }

    /// <summary>The minimum of a tile's pixels, computed anew if triangles have been rasterized since.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private float TileMinInverseDepth(int tileX, int tileY)
    {
        var tile = (tileY * _tilesPerRow) + tileX;
        if (_isTileStale[tile])
        {
            _isTileStale[tile] = false;
            // Beyond the last row or column nothing is ever rasterized or tested.
            var columns = Math.Min(TileSize, Right - Left - (tileX * TileSize));
            var rows = Math.Min(TileSize, Height - (tileY * TileSize));
            ref var first = ref _inverseDepths[(tileY * TileSize * _stride) + (tileX * TileSize)];
            var columnMinima = Vector256.Create(float.PositiveInfinity);
            for (var y = 0; y < rows; y++)
            {
                columnMinima = Vector256.MinNative(columnMinima, Vector256.LoadUnsafe(ref first, (nuint)(y * _stride)));
            }

            var minimum = float.PositiveInfinity;
            for (var x = 0; x < columns; x++)
            {
                minimum = Math.Min(minimum, columnMinima[x]);
            }

            _tileMinInverseDepths[tile] = minimum;
        }

        return _tileMinInverseDepths[tile];
    }

    /// <summary>Tests the pixels of a rectangle that lie in one tile.</summary>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private bool IsTileOccluded(int tileX, int tileY, int left, int top, int right, int bottom, float maxInverseDepth)
    {
        var x = tileX * TileSize;
        var firstRow = Math.Max(top, tileY * TileSize);
        var lastRow = Math.Min(bottom, (tileY * TileSize) + TileSize - 1);
        var firstColumn = Math.Max(left - x, 0);
        var lastColumn = Math.Min(right - x, TileSize - 1);
        var mask = (uint)((1 << (lastColumn + 1)) - (1 << firstColumn));
        ref var pixels = ref _inverseDepths[x];
        for (var y = firstRow; y <= lastRow; y++)
        {
            var row = Vector256.LoadUnsafe(ref pixels, (nuint)(y * _stride));
            if ((~Vector256.GreaterThanOrEqual(row, Vector256.Create(maxInverseDepth)).ExtractMostSignificantBits() & mask) != 0)
            {
                return false;
            }
        }

        return true;
    }
}
