namespace FractalEngine.Core.Queries;

/// <summary>
/// Keeps one context for queries whose caller passes none, so that they don't allocate one each. For any number of threads.
/// </summary>
internal sealed class SpareContext
{
    private QueryContext? _context;

    /// <summary>Takes the context, or makes one while another thread has it.</summary>
    public QueryContext Take() => Interlocked.Exchange(ref _context, null) ?? new();

    /// <summary>Keeps a context for the next query.</summary>
    public void Return(QueryContext context) => _context = context;
}
