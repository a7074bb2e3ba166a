using FractalEngine.Tests.Support;
using Xunit.Abstractions;

[assembly: TestCollectionOrderer($"FractalEngine.Tests.Support.{nameof(LongestCollectionsFirst)}", "FractalEngine.Tests")]

namespace FractalEngine.Tests.Support;

/// <summary>
/// Starts the collections that take longest first, so that at the end no processor waits for the last one. All others keep their order.
/// </summary>
public sealed class LongestCollectionsFirst : ITestCollectionOrderer
{
    // The longest one first. A class without a collection of its own is one.
    private static readonly string[] Longest =
    [
        Render.GlTests.Name, App.Window.DrivenWindow.Collection, NameOf<Approximation.DecimatedElementsTests>(),
        NameOf<Generation.MeshGeneratorTests>(), NameOf<Approximation.RepetitionSearchTests>(), NameOf<Approximation.DamagedSearchTests>(),
        NameOf<App.CommandLineTests>(), NameOf<App.Shell.OutputFileTests>(), NameOf<Physics.Rigid.FastTests>(),
        NameOf<Colliders.ExactFractalColliderDepthTests>(), NameOf<Scenes.InstanceGradientTests>(),
        NameOf<Fractals.DistinctInstancesTests>(), NameOf<App.ShellTests>(), NameOf<App.Commands.RecordedProcessTests>(),
        NameOf<Physics.MovingObjectTests>(), NameOf<App.ExampleImageTests>(), NameOf<Robustness.MemoryTests>(),
    ];

    /// <inheritdoc/>
    public IEnumerable<ITestCollection> OrderTestCollections(IEnumerable<ITestCollection> testCollections) =>
        testCollections.OrderBy(static collection => Array.IndexOf(Longest, collection.DisplayName) is >= 0 and var index
            ? index
            : Longest.Length);

    private static string NameOf<T>() => $"Test collection for {typeof(T).FullName}";
}
