using FractalEngine.Core.Physics.Separation;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Separation;

/// <summary>The queue of contacts that wait, against a sorted set.</summary>
public class GapQueueTests
{
    [Fact]
    public void Take_InEitherDirection_TakesTheNextOfThoseThatWait() => Seeded.Run(60, random =>
    {
        var queue = new GapQueue();
        for (var round = 0; round < 3; round++)
        {
            var (bodyCount, count) = (random.Next(2, 20), random.Next(1, 150));
            queue.Reserve(bodyCount, count);
            (int First, int Second)[] contacts =
                [.. Enumerable.Range(0, count).Select(_ => (random.Next(bodyCount), random.Next(-1, bodyCount)))];
            Array.ForEach(contacts, contact => queue.ClearListsOf(contact.First, contact.Second));
            for (var i = 0; i < count; i++)
            {
                queue.Add(i, contacts[i].First, contacts[i].Second);
            }

            queue.WaitForAll(count);
            SortedSet<int> waiting = [.. Enumerable.Range(0, count)];
            for (var i = 0; i < 2 * count; i++)
            {
                var (contact, isForwards) = (random.Next(-1, count + 1), random.Next(2) == 0);
                var expected = isForwards ? waiting.Where(one => one > contact).Select(static one => (int?)one).FirstOrDefault()
                    : waiting.Where(one => one < contact).Select(static one => (int?)one).LastOrDefault();
                var isTaken = isForwards ? contact < count && queue.TryTakeNext(ref contact)
                    : contact >= 0 && queue.TryTakePrevious(ref contact);
                Assert.Equal(expected is not null, isTaken);
                if (isTaken)
                {
                    Assert.Equal(expected, contact);
                    waiting.Remove(contact);
                    var (first, second) = contacts[contact];
                    var body = random.Next(2) == 0 || second < 0 ? first : second;
                    if (random.Next(4) == 0)
                    {
                        queue.WaitForContactsOf(body);
                        waiting.UnionWith(Enumerable.Range(0, count).Where(i => contacts[i].First == body || contacts[i].Second == body));
                    }
                }
            }
        }
    });
}
