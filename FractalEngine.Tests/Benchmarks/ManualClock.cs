namespace FractalEngine.Tests.Benchmarks;

/// <summary>A clock that stands still until a test advances it.</summary>
internal sealed class ManualClock : TimeProvider
{
    private long _microseconds;

    public override long TimestampFrequency => 1_000_000;

    public override long GetTimestamp() => _microseconds;

    public void Advance(long microseconds) => _microseconds += microseconds;
}
