namespace FractalEngine.Core.Queries;

/// <summary>
/// Keeps one context for queries whose caller passes none, so that they don't allocate one each. For any number of threads.
/// </summary>
internal sealed class SpareContext
{
    private QueryContext? _context;

    /// <summary>Takes the context, or makes one while another thread has it.</summary>
    /// <param name="own">The caller's own context, which is used instead; null for none.</param>
    public QueryContext Take(QueryContext? own = null) => own ?? Interlocked.Exchange(ref _context, null) ?? new();

    /// <summary>Keeps a context for the next query.</summary>
    /// <param name="context">The one that was taken.</param>
    /// <param name="own">The caller's own context, which is not kept; null for none.</param>
    public void Return(QueryContext context, QueryContext? own = null)
    {
        if (own is null)
        {
            _context = context;
        }
    }
}
