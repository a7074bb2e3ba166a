using System.Numerics;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>
/// The contacts of a separation that wait to be tested: all at first, then those of bodies that have been moved. They are taken in the
/// order of their indices, or in the opposite one.
/// </summary>
internal sealed class GapQueue
{
    private const int BitsPerWord = 64;
    // Ends the list of a body's contacts.
    private const int None = -1;

    // A bit for each contact.
    private ulong[] _waiting = [];

    // Lists of the contacts of each body: entry 2·contact is of its first body, the next one of its second.
    private int[] _heads = [];
    private int[] _next = [];
    private int _wordCount;

    /// <summary>Makes room for bodies and contacts.</summary>
    /// <param name="bodyCount">Number of bodies of the world.</param>
    /// <param name="contactCount">Number of contacts of an island.</param>
    public void Reserve(int bodyCount, int contactCount)
    {
        if (_heads.Length < bodyCount)
        {
            _heads = new int[bodyCount];
        }

        if (_next.Length < 2 * contactCount)
        {
            _next = new int[2 * contactCount];
            _waiting = new ulong[(contactCount + BitsPerWord - 1) / BitsPerWord];
        }
    }

    /// <summary>Empties the lists of both bodies of a contact. All have to be emptied before the first contact is added.</summary>
    /// <param name="first">Index of its first body.</param>
    /// <param name="second">Index of its second body; negative for none.</param>
    public void ClearListsOf(int first, int second)
    {
        _heads[first] = None;
        if (second >= 0)
        {
            _heads[second] = None;
        }
    }

    /// <summary>Adds a contact to the lists of its bodies.</summary>
    /// <param name="contact">Its index.</param>
    /// <param name="first">Index of its first body.</param>
    /// <param name="second">Index of its second body; negative for none.</param>
    public void Add(int contact, int first, int second)
    {
        Link(2 * contact, first);
        if (second >= 0)
        {
            Link((2 * contact) + 1, second);
        }
    }

    /// <summary>Lets all contacts of an island wait to be tested.</summary>
    /// <param name="count">Their number.</param>
    public void WaitForAll(int count)
    {
        _wordCount = (count + BitsPerWord - 1) / BitsPerWord;
        _waiting.AsSpan(0, _wordCount).Fill(ulong.MaxValue);
        if (count % BitsPerWord != 0)
        {
            _waiting[_wordCount - 1] = (1UL << (count % BitsPerWord)) - 1;
        }
    }

    /// <summary>Lets the contacts of a body wait.</summary>
    /// <param name="body">Index of the body.</param>
    public void WaitForContactsOf(int body)
    {
        for (var entry = _heads[body]; entry != None; entry = _next[entry])
        {
            _waiting[entry / 2 / BitsPerWord] |= 1UL << (entry / 2 % BitsPerWord);
        }
    }

    /// <summary>Takes the first contact that waits behind another one.</summary>
    /// <param name="contact">The contact before; −1 for none. Receives the one that waits.</param>
    /// <returns>False where none waits.</returns>
    public bool TryTakeNext(ref int contact)
    {
        var start = contact + 1;
        var mask = ulong.MaxValue << (start % BitsPerWord);
        for (var word = start / BitsPerWord; word < _wordCount; word++)
        {
            var bits = _waiting[word] & mask;
            if (bits != 0)
            {
                contact = (word * BitsPerWord) + BitOperations.TrailingZeroCount(bits);
                _waiting[word] &= ~(1UL << (contact % BitsPerWord));
                return true;
            }

            mask = ulong.MaxValue;
        }

        return false;
    }

    /// <summary>Takes the last contact that waits before another one.</summary>
    /// <param name="contact">The contact behind; the number of all for none. Receives the one that waits.</param>
    /// <returns>False where none waits.</returns>
    public bool TryTakePrevious(ref int contact)
    {
        var last = contact - 1;
        if (last < 0)
        {
            return false;
        }

        var mask = ulong.MaxValue >> (BitsPerWord - 1 - (last % BitsPerWord));
        for (var word = last / BitsPerWord; word >= 0; word--)
        {
            var bits = _waiting[word] & mask;
            if (bits != 0)
            {
                contact = (word * BitsPerWord) + BitOperations.Log2(bits);
                _waiting[word] &= ~(1UL << (contact % BitsPerWord));
                return true;
            }

            mask = ulong.MaxValue;
        }

        return false;
    }

    private void Link(int entry, int body)
    {
        _next[entry] = _heads[body];
        _heads[body] = entry;
    }
}
