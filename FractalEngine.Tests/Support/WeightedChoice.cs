namespace FractalEngine.Tests.Support;

/// <summary>Draws one of several kinds, each with a known probability.</summary>
internal static class WeightedChoice
{
    /// <summary>Draws an item. Its probability is its weight over the sum of all weights.</summary>
    public static T Draw<T>(this Random random, params (int Weight, T Item)[] items)
    {
        var rest = random.Next(items.Sum(item => item.Weight));
        var index = 0;
        while (rest >= items[index].Weight)
        {
            rest -= items[index].Weight;
            index++;
        }

        return items[index].Item;
    }

    /// <summary>Tells whether an event of a probability happens.</summary>
    /// <param name="random">The numbers.</param>
    /// <param name="percent">The probability.</param>
    public static bool Happens(this Random random, int percent) => random.Next(100) < percent;
}
