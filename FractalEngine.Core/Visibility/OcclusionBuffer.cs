using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Visibility;

/// <summary>
/// How near the nearest surface is at each pixel of a part of a picture. Nearness is linear on the screen: one divided by the depth in
/// perspective, the depth's negative otherwise. Tiles of 8 by 8 pixels keep the least nearness in them, so that what is hidden is mostly
/// found so without looking at pixels.
/// </summary>
internal sealed class OcclusionBuffer
{
    /// <summary>Pixels of a tile's side, and of a row that is looked at together.</summary>
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

    /// <summary>The first column of the part.</summary>
    public int Left { get; private set; }

    /// <summary>One more than the last column.</summary>
    public int Right { get; private set; }

    /// <summary>Rows of the picture.</summary>
    public int Height { get; private set; }

    /// <summary>Begins a new picture without any surface.</summary>
    /// <param name="left">The first column of the part.</param>
    /// <param name="right">One more than the last.</param>
    /// <param name="height">Of the picture.</param>
    /// <param name="isMultisampled">
    /// True where pixels are quarters of pixels that have four samples: then their samples are where graphics hardware has them (the
    /// standard pattern of Direct3D 11, which OpenGL's drivers follow), else in the middles.
    /// </param>
    public void Clear(int left, int right, int height, bool isMultisampled = false)
    {
        _rowOffsets = isMultisampled ? new(0.25f, 0.75f) : new(0.5f, 0.5f);
        _columnOffsets = Vector256.Create(isMultisampled ? 0.75f : 0.5f, isMultisampled ? 0.25f : 0.5f, 0, 0, 0, 0, 0, 0);
        _columnOffsets = Vector256.Shuffle(_columnOffsets, Vector256.Create(0, 1, 0, 1, 0, 1, 0, 1));
        (_minSampleOffset, _maxSampleOffset) = isMultisampled ? (0.25f, 0.75f) : (0.5f, 0.5f);
        (Left, Right, Height) = (left, right, height);
        _tilesPerRow = (right - left + TileSize - 1) / TileSize;
        // Rows of eight may begin at any column.
        _stride = (_tilesPerRow + 1) * TileSize;
        var rows = (height + TileSize - 1) / TileSize;
        var (pixels, tiles) = (_stride * rows * TileSize, _tilesPerRow * rows);
        if (_inverseDepths.Length < pixels || _tileMinInverseDepths.Length < tiles)
        {
            (_inverseDepths, _tileMinInverseDepths, _isTileStale) = (new float[pixels], new float[tiles], new bool[tiles]);
        }

        _inverseDepths.AsSpan(0, pixels).Fill(float.NegativeInfinity);
        _tileMinInverseDepths.AsSpan(0, tiles).Fill(float.NegativeInfinity);
        _isTileStale.AsSpan(0, tiles).Clear();
    }

    /// <summary>True when everything in a rectangle is nearer than what is asked for.</summary>
    /// <param name="left">First column, within the part.</param>
    /// <param name="top">First row.</param>
    /// <param name="right">Last column, no less than the first.</param>
    /// <param name="bottom">Last row, no less than the first.</param>
    /// <param name="maxInverseDepth">The largest there.</param>
    public bool IsOccluded(int left, int top, int right, int bottom, float maxInverseDepth)
    {
        (left, right) = (left - Left, right - Left);
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

    /// <summary>Draws a triangle: x and y in pixels, y downwards, and nearness.</summary>
    /// <returns>True when it is the nearest at some pixel's middle.</returns>
    public bool RasterizeTriangle(float ax, float ay, float aInverseDepth, float bx, float by, float bInverseDepth, float cx, float cy,
        float cInverseDepth)
    {
        // What is far outside is cut off before it becomes an integer.
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

        // Weights of b and c at a place, and from them the nearness.
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
            // Down even columns samples are elsewhere than down odd ones.
            var offsets = (x & 1) == 0 ? _columnOffsets : Vector256.Shuffle(_columnOffsets, Vector256.Create(1, 0, 1, 0, 1, 0, 1, 0));
            var (weightB0, weightC0, columnInverseDepth) =
                (Vector256.Create(ub) * dx, Vector256.Create(uc) * dx, Vector256.Create(aInverseDepth) + (Vector256.Create(slopeX) * dx));
            var columnMask = Vector256.LessThanOrEqual(columns, Vector256.Create((float)(right - x)));
            for (var y = top; y <= bottom; y++)
            {
                var dy = Vector256.Create(y - ay) + offsets;
                var ox = (y & 1) == 0 ? _rowOffsets.Even : _rowOffsets.Odd;
                var weightB = weightB0 + (Vector256.Create(vb) * dy) + Vector256.Create(ub * ox);
                var weightC = weightC0 + (Vector256.Create(vc) * dy) + Vector256.Create(uc * ox);
                var isInside = Vector256.GreaterThanOrEqual(weightB, Vector256<float>.Zero) & Vector256.GreaterThanOrEqual(weightC,
                    Vector256<float>.Zero)
                    & Vector256.LessThanOrEqual(weightB + weightC, Vector256<float>.One) & columnMask;
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

    private float TileMinInverseDepth(int tileX, int tileY)
    {
        var tile = (tileY * _tilesPerRow) + tileX;
        if (_isTileStale[tile])
        {
            _isTileStale[tile] = false;
            // Beyond the last row or column nothing is ever drawn, and nothing asked.
            var (columns, rows) = (Math.Min(TileSize, Right - Left - (tileX * TileSize)), Math.Min(TileSize, Height - (tileY * TileSize)));
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

    private bool IsTileOccluded(int tileX, int tileY, int left, int top, int right, int bottom, float maxInverseDepth)
    {
        var (x, firstRow, lastRow) =
            (tileX * TileSize, Math.Max(top, tileY * TileSize), Math.Min(bottom, (tileY * TileSize) + TileSize - 1));
        var (firstColumn, lastColumn) = (Math.Max(left - x, 0), Math.Min(right - x, TileSize - 1));
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
