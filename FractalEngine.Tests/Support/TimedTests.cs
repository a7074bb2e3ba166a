namespace FractalEngine.Tests.Support;

/// <summary>
/// Tests with a limit of time that others, in parallel, would use up, of threads that leave the processor to all others, and of what all
/// threads allocate: they run alone.
/// </summary>
[CollectionDefinition(Name, DisableParallelization = true)]
public class TimedTests
{
    public const string Name = "Timed";
}
