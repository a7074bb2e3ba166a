using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Detail;

/// <summary>
/// How near the nearest surface is at each pixel of a part of a picture. Nearness is linear on the screen: one divided by the depth in perspective, the depth's
/// negative otherwise. Tiles of 8 by 8 pixels keep the least nearness in them, so that what is hidden is mostly found so without looking at pixels.
/// </summary>
internal sealed class CoverageBuffer
{
    /// <summary>Pixels of a tile's side, and of a row that is looked at together.</summary>
    public const int Tile = 8;

    private float[] _nearness = [];
    private float[] _farthest = [];
    private bool[] _isStale = [];
    private Vector256<float> _columnOffsets;
    private (float Even, float Odd) _rowOffsets;
    private float _least;
    private float _most;
    private int _stride;
    private int _tiles;

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
    /// <param name="isStaggered">
    /// True where pixels are quarters of pixels that have four samples: then their samples are where graphics hardware has them (the standard pattern of Direct3D 11, which
    /// OpenGL's drivers follow), else in the middles.
    /// </param>
    public void Clear(int left, int right, int height, bool isStaggered = false)
    {
        _rowOffsets = isStaggered ? new(0.25f, 0.75f) : new(0.5f, 0.5f);
        _columnOffsets = Vector256.Create(isStaggered ? 0.75f : 0.5f, isStaggered ? 0.25f : 0.5f, 0, 0, 0, 0, 0, 0);
        _columnOffsets = Vector256.Shuffle(_columnOffsets, Vector256.Create(0, 1, 0, 1, 0, 1, 0, 1));
        (_least, _most) = isStaggered ? (0.25f, 0.75f) : (0.5f, 0.5f);
        (Left, Right, Height) = (left, right, height);
        _tiles = (right - left + Tile - 1) / Tile;
        // Rows of eight may begin at any column.
        _stride = (_tiles + 1) * Tile;
        var rows = (height + Tile - 1) / Tile;
        var (pixels, tiles) = (_stride * rows * Tile, _tiles * rows);
        if (_nearness.Length < pixels || _farthest.Length < tiles)
        {
            (_nearness, _farthest, _isStale) = (new float[pixels], new float[tiles], new bool[tiles]);
        }

        _nearness.AsSpan(0, pixels).Fill(float.NegativeInfinity);
        _farthest.AsSpan(0, tiles).Fill(float.NegativeInfinity);
        _isStale.AsSpan(0, tiles).Clear();
    }

    /// <summary>True when everything in a rectangle is nearer than what is asked for.</summary>
    /// <param name="left">First column, within the part.</param>
    /// <param name="top">First row.</param>
    /// <param name="right">Last column, no less than the first.</param>
    /// <param name="bottom">Last row, no less than the first.</param>
    /// <param name="nearness">The largest there.</param>
    public bool IsHidden(int left, int top, int right, int bottom, float nearness)
    {
        (left, right) = (left - Left, right - Left);
        for (var tileY = top / Tile; tileY <= bottom / Tile; tileY++)
        {
            for (var tileX = left / Tile; tileX <= right / Tile; tileX++)
            {
                if (!(Farthest(tileX, tileY) >= nearness) && !IsHiddenIn(tileX, tileY, left, top, right, bottom, nearness))
                {
                    return false;
                }
            }
        }

        return true;
    }

    /// <summary>Draws a triangle: x and y in pixels, y downwards, and nearness.</summary>
    /// <returns>True when it is the nearest at some pixel's middle.</returns>
    public bool Draw(float ax, float ay, float an, float bx, float by, float bn, float cx, float cy, float cn)
    {
        // What is far outside is cut off before it becomes an integer.
        var left = Math.Max(First(Math.Min(Math.Min(ax, bx), cx)), Left);
        var right = Math.Min(Last(Math.Max(Math.Max(ax, bx), cx)), Right - 1);
        var top = Math.Max(First(Math.Min(Math.Min(ay, by), cy)), 0);
        var bottom = Math.Min(Last(Math.Max(Math.Max(ay, by), cy)), Height - 1);
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
        var (nb, nc) = (bn - an, cn - an);
        var (slopeX, slopeY) = ((ub * nb) + (uc * nc), (vb * nb) + (vc * nc));
        var columns = Vector256.Create(0f, 1, 2, 3, 4, 5, 6, 7);
        var covers = false;
        ref var pixels = ref MemoryMarshal.GetArrayDataReference(_nearness);
        for (var x = left; x <= right; x += Tile)
        {
            var dx = Vector256.Create(x - ax) + columns;
            // Down even columns samples are elsewhere than down odd ones.
            var offsets = (x & 1) == 0 ? _columnOffsets : Vector256.Shuffle(_columnOffsets, Vector256.Create(1, 0, 1, 0, 1, 0, 1, 0));
            var (weightB0, weightC0, near0) = (Vector256.Create(ub) * dx, Vector256.Create(uc) * dx, Vector256.Create(an) + (Vector256.Create(slopeX) * dx));
            var within = Vector256.LessThanOrEqual(columns, Vector256.Create((float)(right - x)));
            for (var y = top; y <= bottom; y++)
            {
                var dy = Vector256.Create(y - ay) + offsets;
                var ox = (y & 1) == 0 ? _rowOffsets.Even : _rowOffsets.Odd;
                var weightB = weightB0 + (Vector256.Create(vb) * dy) + Vector256.Create(ub * ox);
                var weightC = weightC0 + (Vector256.Create(vc) * dy) + Vector256.Create(uc * ox);
                var isInside = Vector256.GreaterThanOrEqual(weightB, Vector256<float>.Zero) & Vector256.GreaterThanOrEqual(weightC, Vector256<float>.Zero)
                    & Vector256.LessThanOrEqual(weightB + weightC, Vector256<float>.One) & within;
                if (isInside == Vector256<float>.Zero)
                {
                    continue;
                }

                var near = near0 + (Vector256.Create(slopeY) * dy) + Vector256.Create(slopeX * ox);
                var place = (nuint)((y * _stride) + x - Left);
                var before = Vector256.LoadUnsafe(ref pixels, place);
                var wins = isInside & Vector256.GreaterThan(near, before);
                if (wins != Vector256<float>.Zero)
                {
                    Vector256.ConditionalSelect(wins, near, before).StoreUnsafe(ref pixels, place);
                    covers = true;
                }
            }
        }

        if (covers)
        {
            MarkStale(left, top, right, bottom);
        }

        return covers;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private int First(float coordinate) => (int)MathF.Ceiling(Math.Max(coordinate, -1e6f) - _most);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private int Last(float coordinate) => (int)MathF.Floor(Math.Min(coordinate, 1e6f) - _least);

    private void MarkStale(int left, int top, int right, int bottom)
    {
        for (var tileY = top / Tile; tileY <= bottom / Tile; tileY++)
        {
            for (var tileX = (left - Left) / Tile; tileX <= (right - Left) / Tile; tileX++)
            {
                _isStale[(tileY * _tiles) + tileX] = true;
            }
        }
    }

    private float Farthest(int tileX, int tileY)
    {
        var tile = (tileY * _tiles) + tileX;
        if (_isStale[tile])
        {
            _isStale[tile] = false;
            // Beyond the last row or column nothing is ever drawn, and nothing asked.
            var (columns, rows) = (Math.Min(Tile, Right - Left - (tileX * Tile)), Math.Min(Tile, Height - (tileY * Tile)));
            ref var first = ref _nearness[(tileY * Tile * _stride) + (tileX * Tile)];
            var least = Vector256.Create(float.PositiveInfinity);
            for (var y = 0; y < rows; y++)
            {
                least = Vector256.MinNative(least, Vector256.LoadUnsafe(ref first, (nuint)(y * _stride)));
            }

            var farthest = float.PositiveInfinity;
            for (var x = 0; x < columns; x++)
            {
                farthest = Math.Min(farthest, least[x]);
            }

            _farthest[tile] = farthest;
        }

        return _farthest[tile];
    }

    private bool IsHiddenIn(int tileX, int tileY, int left, int top, int right, int bottom, float nearness)
    {
        var (x, firstRow, lastRow) = (tileX * Tile, Math.Max(top, tileY * Tile), Math.Min(bottom, (tileY * Tile) + Tile - 1));
        var (from, to) = (Math.Max(left - x, 0), Math.Min(right - x, Tile - 1));
        var mask = (uint)((1 << (to + 1)) - (1 << from));
        ref var pixels = ref _nearness[x];
        for (var y = firstRow; y <= lastRow; y++)
        {
            var row = Vector256.LoadUnsafe(ref pixels, (nuint)(y * _stride));
            if ((~Vector256.GreaterThanOrEqual(row, Vector256.Create(nearness)).ExtractMostSignificantBits() & mask) != 0)
            {
                return false;
            }
        }

        return true;
    }
}
