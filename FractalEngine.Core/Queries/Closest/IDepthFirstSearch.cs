namespace FractalEngine.Core.Queries.Closest;

/// <summary>A <see cref="DepthFirstSearch{TFrame, TBaseMeshes}"/> of one base mesh or of several.</summary>
/// <typeparam name="TFrame">How bounds and positions are compared.</typeparam>
internal interface IDepthFirstSearch<TFrame>
    where TFrame : struct, ISearchFrame<TFrame>
{
    /// <summary>Searches the whole fractal.</summary>
    /// <param name="frame">The frame of the whole fractal.</param>
    /// <param name="search">The state of the search.</param>
    void Run(TFrame frame, ref FractalSearchState search);
}
