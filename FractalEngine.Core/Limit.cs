namespace FractalEngine.Core;

/// <summary>A limit that bounds time or memory, with its reason. It applies to the whole process.</summary>
/// <remarks>Limits are changed before anything is loaded. What was loaded before is not tested again.</remarks>
/// <param name="name">Name on the command line.</param>
/// <param name="value">Default value.</param>
/// <param name="subject">What is counted.</param>
/// <param name="reason">Why there is a limit at this value.</param>
/// <param name="maximum">Largest value that the limit can be given.</param>
public sealed class Limit(string name, long value, string subject, string reason, long maximum = int.MaxValue)
{
    private long _value = value;

    /// <summary>Name on the command line.</summary>
    public string Name { get; } = name;

    /// <summary>Value unless it is changed.</summary>
    public long Default { get; } = value;

    /// <summary>The things that are counted, in the plural.</summary>
    public string Subject { get; } = subject;

    /// <summary>Why there is a limit at this value.</summary>
    public string Reason { get; } = reason;

    /// <summary>Largest value that the limit can be given.</summary>
    public long Maximum { get; } = maximum;

    /// <summary>The value that applies now: the default, or what it was changed to.</summary>
    /// <exception cref="ArgumentOutOfRangeException">The new value is less than 1 or more than <see cref="Maximum"/>.</exception>
    public long Value
    {
        get => Volatile.Read(ref _value);
        set
        {
            ArgumentOutOfRangeException.ThrowIfLessThan(value, 1);
            ArgumentOutOfRangeException.ThrowIfGreaterThan(value, Maximum);
            Volatile.Write(ref _value, value);
        }
    }
}
