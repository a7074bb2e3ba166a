using System.Runtime.InteropServices;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>Sorts numbers by small keys, in linear time. Those of one key keep their order.</summary>
internal static class CountingSort
{
    /// <summary>Sorts numbers by their keys.</summary>
    /// <param name="count">How many there are.</param>
    /// <param name="numbers">The numbers; empty for all from 0 to the count.</param>
    /// <param name="keyOf">The key of a number; negative for one that is left out.</param>
    /// <param name="ends">Of each key: receives where its numbers end.</param>
    /// <param name="sorted">Receives the numbers.</param>
    public static void Sort(int count, ReadOnlySpan<int> numbers, Func<int, int> keyOf, Span<int> ends, List<int> sorted)
    {
        ends.Clear();
        for (var i = 0; i < count; i++)
        {
            if (keyOf(numbers.IsEmpty ? i : numbers[i]) is >= 0 and var key)
            {
                ends[key]++;
            }
        }

        var start = 0;
        foreach (ref var end in ends)
        {
            (end, start) = (start, start + end);
        }

        CollectionsMarshal.SetCount(sorted, start);
        for (var i = 0; i < count; i++)
        {
            var number = numbers.IsEmpty ? i : numbers[i];
            if (keyOf(number) is >= 0 and var key)
            {
                sorted[ends[key]++] = number;
            }
        }
    }
}
