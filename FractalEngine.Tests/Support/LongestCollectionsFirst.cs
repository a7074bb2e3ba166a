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
        App.Window.DrivenWindow.Collection, Render.GlTests.Name, NameOf<App.CommandLineTests>(), NameOf<App.ImageCommandTests>(),
        NameOf<App.ExampleImageTests>(), NameOf<App.Commands.AnimateCommandTests>(), NameOf<Physics.MovingObjectTests>(),
        NameOf<App.Commands.SimulateCommandTests>(), NameOf<App.ShellTests>(), NameOf<Physics.CompoundTests>(),
        NameOf<Robustness.MemoryTests>(), NameOf<Generation.MeshGeneratorTests>(), NameOf<Visibility.VisibleSetLimitTests>(),
        NameOf<App.Commands.QueryCommandTests>(), NameOf<App.TracedAnimationTests>(),
    ];

    /// <inheritdoc/>
    public IEnumerable<ITestCollection> OrderTestCollections(IEnumerable<ITestCollection> testCollections) =>
        testCollections.OrderBy(static collection => Array.IndexOf(Longest, collection.DisplayName) is >= 0 and var index
            ? index
            : Longest.Length);

    private static string NameOf<T>() => $"Test collection for {typeof(T).FullName}";
}
