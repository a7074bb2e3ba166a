using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>
/// The GL objects of one context: who lives, and what waits for deletion. GL calls are made on the context's thread only; an object
/// that is disposed elsewhere waits here until that thread comes by.
/// </summary>
internal sealed class GlResources
{
    private readonly Lock _lock = new();
    private readonly HashSet<GlObject> _liveObjects = [];
    private readonly List<GlObject> _pendingDeletion = [];
    private readonly int _threadId = Environment.CurrentManagedThreadId;

    /// <summary>What is bound.</summary>
    public GlState State { get; } = new();

    /// <summary>Uploads of what changes from picture to picture: made, and not needed.</summary>
    public RedundancyFilter UploadFilter { get; } = new();

    /// <summary>True on the thread that may call GL.</summary>
    public bool IsGlThread => Environment.CurrentManagedThreadId == _threadId;

    /// <summary>The labels of all objects that are not disposed, sorted.</summary>
    public IReadOnlyList<string> LiveObjects
    {
        get
        {
            lock (_lock)
            {
                return [.. _liveObjects.Select(item => item.ToString()).Order(StringComparer.Ordinal)];
            }
        }
    }

    /// <summary>Deletes what was disposed on other threads. Costs a lock when there is nothing.</summary>
    public void DeletePending()
    {
        RequireGlThread();
        lock (_lock)
        {
            foreach (var item in _pendingDeletion)
            {
                item.DeleteNow();
            }

            _pendingDeletion.Clear();
        }
    }

    /// <summary>Deletes everything, and names what its owners should have disposed.</summary>
    /// <returns>The labels of the leaked objects.</returns>
    public IReadOnlyList<string> DeleteAll()
    {
        DeletePending();
        var leaks = LiveObjects;
        foreach (var item in _liveObjects.ToArray())
        {
            item.Dispose();
        }

        return leaks;
    }

    /// <summary>Turns GL's error flag into an exception.</summary>
    /// <param name="operation">What was being done, for the message.</param>
    /// <exception cref="GlException">GL reports an error.</exception>
    public void ThrowOnError(string operation)
    {
        RequireGlThread();
        if (GL.GetError() is var error and not ErrorCode.NoError)
        {
            throw new GlException($"{operation}: OpenGL reports {error}");
        }
    }

    internal void RequireGlThread()
    {
        if (!IsGlThread)
        {
            throw new InvalidOperationException("GL objects can be used on the thread of their context only");
        }
    }

    internal void Add(GlObject item)
    {
        RequireGlThread();
        lock (_lock)
        {
            _liveObjects.Add(item);
        }
    }

    internal void Remove(GlObject item)
    {
        lock (_lock)
        {
            _liveObjects.Remove(item);
            if (!IsGlThread)
            {
                _pendingDeletion.Add(item);
                return;
            }
        }

        item.DeleteNow();
    }
}
