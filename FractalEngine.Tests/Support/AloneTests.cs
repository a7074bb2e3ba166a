namespace FractalEngine.Tests.Support;

/// <summary>Tests of what all threads of the process allocate, which those of other tests would add to: they run alone.</summary>
[CollectionDefinition(Name, DisableParallelization = true)]
public class AloneTests
{
    public const string Name = "Alone";
}
