using System.Collections.Concurrent;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.Tests.Parsing.Meshes;

/// <summary>Tests that work runs once for each thread, and that only the caller's run is told so.</summary>
public sealed class WorkersTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(5)]
    public void Run_OnSomeThreads_CallsTheWorkAsOftenAndOnceForTheCaller(int count)
    {
        var calls = new ConcurrentQueue<(bool IsCaller, int Thread)>();
        Workers.Run(count, isCaller => calls.Enqueue((isCaller, Environment.CurrentManagedThreadId)));
        Assert.Equal(count, calls.Count);
        Assert.Equal((true, Environment.CurrentManagedThreadId), Assert.Single(calls, static call => call.IsCaller));
    }
}
