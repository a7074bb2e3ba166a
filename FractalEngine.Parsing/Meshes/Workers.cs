namespace FractalEngine.Parsing.Meshes;

/// <summary>Runs the same work on several threads, one of which is the caller's.</summary>
internal static class Workers
{
    /// <summary>Returns when all threads are done.</summary>
    /// <param name="count">Number of threads, at least one.</param>
    /// <param name="work">The work, which receives whether it runs on the caller's thread.</param>
    public static void Run(int count, Action<bool> work)
    {
        var others = new Task[count - 1];
        for (var i = 0; i < others.Length; i++)
        {
            others[i] = Task.Run(() => work(false));
        }

        work(true);
        Task.WaitAll(others);
    }
}
