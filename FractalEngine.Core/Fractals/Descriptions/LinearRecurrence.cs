using System.Numerics;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>Computes far terms of integer sequences in which each term is a fixed sum of multiples of some terms before it.</summary>
internal static class LinearRecurrence
{
    // A Mersenne prime, far larger than the coefficients of usual sequences; those found modulo it are proved before use.
    private static readonly BigInteger Prime = BigInteger.Pow(2, 2203) - 1;

    /// <summary>Computes a term of a sequence.</summary>
    /// <param name="terms">The sequence, as far as it is asked for; null for infinitely many.</param>
    /// <param name="maxOrder">No fewer terms than those by which each later one is determined.</param>
    /// <param name="index">Index of the term, from 0.</param>
    /// <remarks>
    /// A recurrence that holds for twice the order of a sequence holds for all of it. So few terms are multiplied, whatever the index.
    /// </remarks>
    public static BigInteger? TermAt(IEnumerable<BigInteger?> terms, int maxOrder, int index)
    {
        if (index < 2 * maxOrder)
        {
            return terms.ElementAt(index);
        }

        BigInteger[] first = [.. terms.Take(2 * maxOrder).Select(static term => term!.Value)];
        BigInteger[] coefficients = [.. FindCoefficients(first).Select(static one => one > Prime / 2 ? one - Prime : one)];
        return Enumerable.Range(coefficients.Length, first.Length - coefficients.Length)
            .All(i => first[i] == Predict(coefficients, first, i))
            ? TermAt(coefficients, first, index)
            : terms.ElementAt(index);
    }

    private static BigInteger Predict(BigInteger[] coefficients, BigInteger[] terms, int index)
    {
        var sum = BigInteger.Zero;
        for (var i = 0; i < coefficients.Length; i++)
        {
            sum += coefficients[i] * terms[index - 1 - i];
        }

        return sum;
    }

    /// <summary>Finds the shortest recurrence of some terms modulo the prime (Berlekamp and Massey).</summary>
    /// <returns>Factors of the terms before, the nearest first.</returns>
    private static BigInteger[] FindCoefficients(BigInteger[] terms)
    {
        BigInteger[] found = [];
        BigInteger[] previous = [];
        var previousIndex = -1;
        var previousError = BigInteger.One;
        for (var i = 0; i < terms.Length; i++)
        {
            var error = Modulo(terms[i] - Predict(found, terms, i));
            if (error.IsZero)
            {
                continue;
            }

            var factor = error * BigInteger.ModPow(previousError, Prime - 2, Prime);
            var shift = i - previousIndex;
            var next = new BigInteger[Math.Max(found.Length, shift + previous.Length)];
            found.CopyTo(next, 0);
            next[shift - 1] += factor;
            for (var j = 0; j < previous.Length; j++)
            {
                next[shift + j] -= factor * previous[j];
            }

            if (next.Length > found.Length)
            {
                previous = found;
                previousIndex = i;
                previousError = error;
            }

            found = Array.ConvertAll(next, Modulo);
        }

        return found;
    }

    private static BigInteger Modulo(BigInteger number)
    {
        var remainder = number % Prime;
        return remainder.Sign < 0 ? remainder + Prime : remainder;
    }

    /// <summary>Computes a term from the power of x with its index, modulo the characteristic polynomial (Kitamasa's method).</summary>
    private static BigInteger TermAt(BigInteger[] coefficients, BigInteger[] terms, int index)
    {
        var order = coefficients.Length;
        // The coefficient of x⁰ comes first.
        var power = new BigInteger[Math.Max(order, 1)];
        power[0] = 1;
        for (var bit = BitOperations.Log2((uint)index); bit >= 0; bit--)
        {
            var square = new BigInteger[2 * power.Length];
            var shift = index >> bit & 1;
            for (var i = 0; i < order; i++)
            {
                for (var j = i; j < order; j++)
                {
                    square[i + j + shift] += (power[i] * power[j]) << (i < j ? 1 : 0);
                }
            }

            for (var i = square.Length - 1; i >= order; i--)
            {
                for (var j = 0; j < order; j++)
                {
                    square[i - 1 - j] += square[i] * coefficients[j];
                }
            }

            power = square[..power.Length];
        }

        return power.Zip(terms, static (factor, term) => factor * term).Aggregate(BigInteger.Add);
    }
}
