using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>
/// A stream of pseudo-random numbers that depends on a purpose and a seed alone, so that each input is the same on every run.
/// </summary>
/// <remarks>SplitMix64 (Steele, Lea and Flood, OOPSLA 2014); the state begins with a hash of purpose and seed.</remarks>
internal sealed class SeededRandom
{
    private const ulong Gamma = 0x9E3779B97F4A7C15;

    private ulong _state;

    /// <summary>Begins a stream of its own for a purpose and a seed.</summary>
    public SeededRandom(string purpose, int seed)
    {
        // FNV-1a.
        var hash = 14695981039346656037;
        foreach (var character in purpose)
        {
            hash = (hash ^ character) * 1099511628211;
        }

        _state = Mix(hash + ((ulong)(uint)seed * Gamma));
    }

    /// <summary>Draws a number from 0, included, to 1, excluded.</summary>
    public double Fraction() => (Bits() >> 11) * (1.0 / (1UL << 53));

    /// <summary>Draws a number between two ends.</summary>
    public double Between(double minimum, double maximum) => minimum + ((maximum - minimum) * Fraction());

    /// <summary>Draws a number between two ends, rounded to two decimals half of the times, as people write them.</summary>
    public double Written(double minimum, double maximum)
    {
        var number = Between(minimum, maximum);
        return Chance(0.5) ? Math.Clamp(Math.Round(number, 2), minimum, maximum) : number;
    }

    /// <summary>Draws an integer from 0 to one less than a count.</summary>
    public int Index(int count) => (int)(((UInt128)Bits() * (ulong)count) >> 64);

    /// <summary>Draws an integer between two ends, both included.</summary>
    public int Integer(int minimum, int maximum) => minimum + Index(maximum - minimum + 1);

    /// <summary>Tells, with the given probability, that something happens.</summary>
    public bool Chance(double probability) => Fraction() < probability;

    /// <summary>Draws one of several things, each as probable.</summary>
    public T Pick<T>(params ReadOnlySpan<T> things) => things[Index(things.Length)];

    /// <summary>Draws a point within a box around the origin.</summary>
    public Vector InBox(double halfSize) =>
        new(Between(-halfSize, halfSize), Between(-halfSize, halfSize), Between(-halfSize, halfSize));

    /// <summary>Draws a point of the unit ball, evenly by volume.</summary>
    public Vector InBall()
    {
        var point = InBox(1);
        while (point.LengthSquared() > 1)
        {
            point = InBox(1);
        }

        return point;
    }

    /// <summary>Draws a unit vector, evenly over the sphere.</summary>
    public Vector Direction()
    {
        var point = InBall();
        while (point.LengthSquared() < 0.01)
        {
            point = InBall();
        }

        return point / point.Length();
    }

    /// <summary>Draws a rotation about any axis by any angle.</summary>
    public Matrix GenericRotation() => Matrix.Rotation(Direction(), Between(0, 2 * Math.PI));

    /// <summary>Draws one of the rotations that people write: quarters, sixths and thirds about an axis, or about a diagonal.</summary>
    public Matrix NiceRotation()
    {
        if (Chance(0.15))
        {
            return new(Vector.J, Vector.K, Vector.I);
        }

        var angle = Pick(90.0, 180, 270, 120, 240, 60, 300, 45, 30);
        var angles = Pick(new Vector(angle, 0, 0), new Vector(0, angle, 0), new Vector(0, 0, angle));
        return angles.LocalAxesFromDegrees();
    }

    /// <summary>Brings things into an order of which all are as probable.</summary>
    public void Shuffle<T>(Span<T> things)
    {
        for (var last = things.Length - 1; last > 0; last--)
        {
            var other = Index(last + 1);
            (things[last], things[other]) = (things[other], things[last]);
        }
    }

    /// <summary>Makes the numbers from 0 to one less than a count, in an order of which all are as probable.</summary>
    public int[] Permutation(int count)
    {
        var order = new int[count];
        for (var i = 0; i < count; i++)
        {
            order[i] = i;
        }

        Shuffle<int>(order);
        return order;
    }

    private ulong Bits()
    {
        _state += Gamma;
        return Mix(_state);
    }

    private static ulong Mix(ulong bits)
    {
        bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9;
        bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EB;
        return bits ^ (bits >> 31);
    }
}
