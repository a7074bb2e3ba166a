using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>
/// Registers the GL objects of one context, alive and pending deletion. GL is called only on the context's thread; an object that is
/// disposed on another thread waits here until the context's thread next draws.
/// </summary>
internal sealed class GlResources
{
    private readonly Lock _lock = new();
    private readonly HashSet<GlObject> _liveObjects = [];
    private readonly List<GlObject> _pendingDeletion = [];
    private readonly int _threadId = Environment.CurrentManagedThreadId;

    /// <summary>Bindings of the context.</summary>
    public GlState State { get; } = new();

    /// <summary>Counts the uploads of data that changes between frames, and skips redundant ones.</summary>
    public RedundancyFilter UploadFilter { get; } = new();

    /// <summary>True on the thread that may call GL.</summary>
    public bool IsGlThread => Environment.CurrentManagedThreadId == _threadId;

    /// <summary>Kinds and labels of all objects that are not disposed, sorted.</summary>
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

    /// <summary>Deletes the objects that were disposed on other threads. Costs a lock when there are none.</summary>
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

    /// <summary>Deletes all objects, and returns the labels of those that their owners did not dispose.</summary>
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
    /// <param name="operation">Operation in progress, for the message.</param>
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
