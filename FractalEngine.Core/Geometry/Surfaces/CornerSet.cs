using System.Numerics;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>A set of corners of a polygon, one bit each, in which the next one is found fast.</summary>
internal sealed class CornerSet
{
    private const int BitsPerWord = 64;

    private ulong[] _words = [];
    private int _wordCount;

    /// <summary>Removes all corners, and makes room for a number of them.</summary>
    public void Reset(int count)
    {
        _wordCount = (count + BitsPerWord - 1) / BitsPerWord;
        if (_words.Length < _wordCount)
        {
            _words = new ulong[_wordCount];
        }

        Array.Clear(_words, 0, _wordCount);
    }

    /// <summary>Adds or removes a corner.</summary>
    public void Set(int corner, bool isMember)
    {
        var bit = 1UL << (corner % BitsPerWord);
        ref var word = ref _words[corner / BitsPerWord];
        word = isMember ? word | bit : word & ~bit;
    }

    /// <summary>Finds the first member from a corner on, around the polygon; −1 if the set is empty.</summary>
    public int FindFrom(int corner)
    {
        var index = corner / BitsPerWord;
        var word = _words[index] & (ulong.MaxValue << (corner % BitsPerWord));
        for (var visited = 0; visited <= _wordCount; visited++)
        {
            if (word != 0)
            {
                return (index * BitsPerWord) + BitOperations.TrailingZeroCount(word);
            }

            index = index + 1 == _wordCount ? 0 : index + 1;
            word = _words[index];
        }

        return -1;
    }
}
